#!/bin/bash
# Static analysis: shellcheck of all scripts, clang-format of all sources, cppcheck of the library and the programs, and
# clang-tidy with --tidy.
# Prints what they find and fails if there is anything.
# usage: analyse.sh [--tidy]
#   --tidy   also clang-tidy: some minutes the first time, then for what has changed

. "$(dirname "$0")/../scripts/common.sh"
tidy=no
case ${1:-} in
    --tidy) tidy=yes ;;
    "") ;;
    *) die "unknown argument $1" ;;
esac
logs=${TMPDIR:-/tmp}
packages=(shellcheck clang-format-14 cppcheck)
[ $tidy = no ] || packages+=("${packages_build[@]}" clang-tidy)
install_packages "$logs/rsackermann-apt-install.log" "${packages[@]}"
cd "$root"
# Not by git, which doesn't answer in somebody else's checkout or a copy without its history.
mapfile -t scripts < <(find .ci/run cmake doc modules perf samples scripts test -name '*.sh' -o -path .ci/run | sort)
mapfile -t sources < <(find modules/rsackermann/src samples -name '*.cpp' | sort)
mapfile -t formatted < <(find cmake modules perf samples test -name '*.[ch]pp' | sort)

step "shellcheck, ${#scripts[@]} scripts"
for script in "${scripts[@]}"; do
    # What is only sourced has no first line that names its interpreter.
    [ -x "$script" ] || [ "$(head -c 2 "$script")" != '#!' ] || die "$script can't be executed"
done
shellcheck "${scripts[@]}"

step "clang-format, ${#formatted[@]} files"
clang-format-14 --dry-run --Werror "${formatted[@]}"

step "cppcheck, ${#sources[@]} sources"
cppcheck --quiet --std=c++14 --language=c++ --enable=warning,portability --inline-suppr --library=opencv2 \
    --suppress=unknownMacro --suppressions-list=test/cppcheck_suppressions.txt --error-exitcode=1 \
    --template='{file}:{line}: {id}: {message}' \
    -I modules/rsackermann/include -I modules/rsackermann/src -I samples/common "${sources[@]}"

if [ $tidy = yes ]; then
    step "clang-tidy, ${#sources[@]} sources"
    # It can't read the precompiled headers of gcc.
    logged build-tidy/configure.log cmake -G Ninja -S . -B build-tidy -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
        -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
    test/tidy.py build-tidy "$cache/clang-tidy" "${sources[@]}"
fi
echo "nothing found"
