# shellcheck shell=bash disable=SC2034 # what is set here is used by the script that sources this
# Parts that the scripts share: sourced, not run.

set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cache=${XDG_CACHE_HOME:-$HOME/.cache}/rsackermann

# The packages of each task on Debian 12.
packages_build=(g++ cmake ninja-build ccache libopencv-dev libeigen3-dev nlohmann-json3-dev libyaml-cpp-dev zlib1g-dev)
packages_clang=(clang libclang-rt-14-dev llvm) # llvm: the sanitizers ask llvm-symbolizer for names
packages_test=(dpkg-dev doxygen ffmpeg texlive-binaries gnuplot-nox pkg-config parallel python3-dev python3-numpy
               python3-opencv python3-pip python3-setuptools python3-venv python3-wheel libjpeg-dev libpng-dev
               zlib1g-dev opencl-c-headers ocl-icd-libopencl1 pocl-opencl-icd)
packages_browser=(chromium)

# Runs a program without randomised addresses, where that is allowed: the sanitizers of clang 14 end at the start if the
# kernel randomises more of their bits than they know of.
fixed_addresses=()
if setarch -R true 2>/dev/null; then
    fixed_addresses=(setarch -R)
fi

die()
{
    echo "$(basename "$0"): $*" >&2
    exit 1
}

step()
{
    echo "== $*"
}

# Runs a command with its output in a log file; shows the log's end if the command fails.
# usage: logged LOG COMMAND...
logged()
{
    local log=$1
    shift
    mkdir -p "$(dirname "$log")"
    if ! "$@" >"$log" 2>&1 </dev/null; then
        tail -n 60 "$log" >&2
        die "'$*' failed; all of its output is in $log"
    fi
}

# As logged, for a build: shows in one line how many of its steps are done.
# usage: show_progress LOG COMMAND...
show_progress()
{
    local log=$1 step
    logged "$@" &
    while sleep 1 && kill -0 $! 2>/dev/null; do
        step=$(grep -o '^\[[0-9]*/[0-9]*\]' "$log" | tail -n 1) || true
        printf '\r%s' "$step"
    done
    echo
    wait $!
}

# Has ccache find objects again from another checkout, and those with precompiled headers, also if CMake wrote the list
# of these headers in the second in which they are compiled. Builds that ctest starts have other variables of the locale.
# usage: use_ccache DIRECTORY_OF_THE_SOURCES
use_ccache()
{
    export CCACHE_BASEDIR=$1 CCACHE_NOHASHDIR=1
    export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime,locale
}

as_root()
{
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    else
        sudo "$@"
    fi
}

is_installed()
{
    [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# usage: install_packages LOG PACKAGE...
install_packages()
{
    local log=$1 package missing=()
    shift
    for package in "$@"; do
        is_installed "$package" || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    step "Installing ${missing[*]}"
    logged "$log.update" as_root apt-get update
    logged "$log" as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}"
}
