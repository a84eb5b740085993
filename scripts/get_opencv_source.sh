#!/bin/bash
# Fetches the source of the installed OpenCV, main and contrib modules, and prints the directory that it is in.
#
# It comes from the Debian source package, through an apt configuration of its own, so that the lists of the system stay
# as they are. The directory is kept in ${XDG_CACHE_HOME:-~/.cache}/rsackermann and used again.

. "$(dirname "$0")/common.sh"

version=$(dpkg-query -W -f='${source:Version}' libopencv-dev) || die "libopencv-dev isn't installed"
target=$cache/opencv-$version
if [ ! -d "$target" ]; then
    mkdir -p "$cache"
    work=$(mktemp -d "$cache/source.XXXXXX")
    trap 'rm -rf "$work"' EXIT
    mkdir -p "$work/lists/partial"

    # The sources of Debian that the system has, with deb-src for deb.
    targets=(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' 'Origin: Debian')
    "${targets[@]}" | sort -u | sed 's/^/deb-src /' >"$work/sources.list"
    if [ ! -s "$work/sources.list" ]; then
        logged "$cache/apt-update.log" as_root apt-get update
        "${targets[@]}" | sort -u | sed 's/^/deb-src /' >"$work/sources.list"
    fi
    [ -s "$work/sources.list" ] || die "apt has no source of Debian configured"

    apt=(apt-get -o "Dir::Etc::sourcelist=$work/sources.list" -o Dir::Etc::sourceparts=- -o "Dir::State::lists=$work/lists"
         -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= -o APT::Sandbox::User=root)
    logged "$cache/source-update.log" "${apt[@]}" update
    cd "$work"
    logged "$cache/source-download.log" "${apt[@]}" --only-source --download-only source "opencv=$version"
    logged "$cache/source-unpack.log" dpkg-source --no-copy --no-check -x opencv_*.dsc unpacked
    mv unpacked "$target"
fi
echo "$target"
