// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_MAP_OCL_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_MAP_OCL_HPP

#include "maps.hpp"
#include "opencv2/core/opencl/ocl_defs.hpp"

#ifdef HAVE_OPENCL

namespace cv { namespace rsackermann {

/** Makes a map on an OpenCL device, in single precision; see WarpMapGenerator::initRectifyMap and initDistortMap.
@return false if the device can't; then nothing is promised about the outputs.
*/
bool oclWarpMap(WarpDirection warp, const RollingShutterCamera& camera, const WarpMapGenerator::Params& params,
                const AckermannMotion& motion, int m1type, OutputArray map1, OutputArray map2, OutputArray mask);

}} // namespace cv::rsackermann

#endif // HAVE_OPENCL

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_MAP_OCL_HPP
