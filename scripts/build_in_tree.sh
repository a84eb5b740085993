#!/bin/bash
# Builds the module inside of OpenCV, in the version that is installed, with its tests and the Python wrapper.
#
# The build directory is kept in the cache, so that OpenCV itself is built once. The module is seen through a link
# there, so that ccache finds its objects again from another checkout, and is always built anew from this one.
# usage: build_in_tree.sh BUILD_DIRECTORY LINK_TO_CHECKOUT LOG_DIRECTORY

. "$(dirname "$0")/common.sh"
[ $# -eq 3 ] || die "usage: build_in_tree.sh BUILD_DIRECTORY LINK_TO_CHECKOUT LOG_DIRECTORY"
build=$1 checkout=$2 logs=$3

source=$("$root/scripts/get_opencv_source.sh")
mkdir -p "$build" "$(dirname "$checkout")"
ln -sfn "$root" "$checkout"

# Nothing of the module that was built before, maybe from another checkout, is kept.
rm -rf "$build"/modules/rsackermann "$build"/bin/opencv_{test,perf}_rsackermann "$build"/lib/libopencv_rsackermann.* \
       "$build"/modules/python_bindings_generator "$build"/modules/python3

# Debian's source package comes without OpenCV's copies of other libraries, so the parts that need them are off.
options=(
    # Without what takes a compiler long: this build is for tests.
    -DCMAKE_BUILD_TYPE=Release "-DCMAKE_C_FLAGS_RELEASE=-O1 -DNDEBUG" "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG"
    -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DENABLE_CCACHE=OFF
    "-DOPENCV_EXTRA_MODULES_PATH=$source/contrib/modules;$checkout/modules"
    "-DBUILD_LIST=ximgproc,calib3d,geometry,video,imgcodecs,videoio,highgui,ts,python3,rsackermann"
    -DBUILD_TESTS=ON -DOPENCV_BUILD_TEST_MODULES_LIST=rsackermann
    -DBUILD_PERF_TESTS=ON -DOPENCV_BUILD_PERF_TEST_MODULES_LIST=rsackermann
    -DBUILD_EXAMPLES=OFF -DBUILD_opencv_apps=OFF -DBUILD_JAVA=OFF
    -DPYTHON3_EXECUTABLE=/usr/bin/python3 -DPYTHON_DEFAULT_EXECUTABLE=/usr/bin/python3
    -DCPU_DISPATCH=AVX2
    -DWITH_OPENJPEG=OFF -DWITH_JASPER=OFF -DWITH_QUIRC=OFF -DWITH_TIFF=OFF -DWITH_WEBP=OFF -DWITH_OPENEXR=OFF
    -DBUILD_ZLIB=OFF -DBUILD_JPEG=OFF -DBUILD_PNG=OFF -DWITH_PROTOBUF=OFF -DWITH_ADE=OFF -DWITH_ITT=OFF -DWITH_IPP=OFF
    -DOPENCL_INCLUDE_DIR=/usr/include/CL
    -DWITH_FFMPEG=OFF -DWITH_GSTREAMER=OFF -DWITH_GTK=OFF -DWITH_LAPACK=OFF
)
use_ccache "$cache"
logged "$logs/in-tree-configure.log" cmake -G Ninja -S "$source" -B "$build" "${options[@]}"
logged "$logs/in-tree-build.log" cmake --build "$build" \
    --target opencv_test_rsackermann opencv_perf_rsackermann opencv_python3

# OpenCV accepts no contribution with warnings.
if grep -E 'rsackermann[^ ]*:[0-9]+:[0-9]+: warning:' "$logs/in-tree-build.log" >&2; then
    die "the module's in-tree build has warnings"
fi
