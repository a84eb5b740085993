#!/bin/bash
# Fetches the source of the installed OpenCV, main and contrib modules, and prints the directory that it is in.
# usage: get_opencv_source.sh [--fetched | VERSION_OF_DEBIANS_PACKAGE]
#   --fetched   fetch nothing; fails if it hasn't been fetched before
#
# It comes from the Debian source package, through an apt configuration of its own, so that the lists of the system stay
# as they are. The directory is kept in ${XDG_CACHE_HOME:-~/.cache}/rsackermann and used again.

. "$(dirname "$0")/common.sh"

# Does with the archives what dpkg-source does with the description.
unpack_archives()
{
    local name patch
    for name in orig orig-contrib debian; do
        ls opencv_*."$name".tar.* >/dev/null 2>&1 ||
            die "the mirror doesn't have the source of opencv $version; what it said is in $cache/source-download.log"
    done
    mkdir -p unpacked/contrib
    tar -xf opencv_*.orig.tar.* -C unpacked --strip-components=1
    tar -xf opencv_*.orig-contrib.tar.* -C unpacked/contrib --strip-components=1
    tar -xf opencv_*.debian.tar.* -C unpacked
    while read -r patch; do
        logged "$cache/source-unpack.log" patch -d unpacked -p1 -i "debian/patches/$patch"
    done < <(sed -e 's/ *#.*//' -e '/^$/d' unpacked/debian/patches/series)
}

fetch=yes
if [ "${1:-}" = --fetched ]; then
    fetch=no
    shift
fi
version=${1:-$(dpkg-query -W -f='${source:Version}' libopencv-dev)} || die "libopencv-dev isn't installed"
target=$cache/opencv-$version
if [ ! -d "$target" ]; then
    [ $fetch = yes ] || die "the source of OpenCV hasn't been fetched"
    mkdir -p "$cache"
    work=$(mktemp -d "$cache/source.XXXXXX")
    trap 'rm -rf "$work"' EXIT
    mkdir -p "$work/lists/partial"

    # The sources of Debian that the system has, with deb-src for deb.
    targets=(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)'
             'Created-By: Packages' 'Origin: Debian')
    "${targets[@]}" | sort -u | sed 's/^/deb-src /' >"$work/sources.list"
    if [ ! -s "$work/sources.list" ]; then
        logged "$cache/apt-update.log" as_root apt-get update
        "${targets[@]}" | sort -u | sed 's/^/deb-src /' >"$work/sources.list"
    fi
    [ -s "$work/sources.list" ] || die "apt has no source of Debian configured"

    apt=(apt-get -o "Dir::Etc::sourcelist=$work/sources.list" -o Dir::Etc::sourceparts=-
         -o "Dir::State::lists=$work/lists" -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache=
         -o APT::Sandbox::User=root)
    logged "$cache/source-update.log" "${apt[@]}" update
    cd "$work"
    # Fetches what there is of the package: a mirror may lack the small file that describes it.
    "${apt[@]}" --only-source --download-only source "opencv=$version" >"$cache/source-download.log" 2>&1 || true
    if ls opencv_*.dsc >/dev/null 2>&1 && ls opencv_*.orig.tar.* >/dev/null 2>&1; then
        logged "$cache/source-unpack.log" dpkg-source --no-copy --no-check -x opencv_*.dsc unpacked
    else
        unpack_archives
    fi
    mv unpacked "$target"
fi
echo "$target"
