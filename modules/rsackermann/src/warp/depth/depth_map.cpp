// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "opencv2/rsackermann/depth_map.hpp"
#include "../../checks.hpp"

namespace cv { namespace rsackermann {

DepthMap::DepthMap() : camera(DEPTH_RAW), kind(DEPTH_METRIC), scale(1), shift(0) {}

DepthMap::DepthMap(const Mat& values_, int camera_, double scale_, int kind_)
    : values(values_), camera(camera_), kind(kind_), scale(scale_), shift(0)
{
}

bool DepthMap::empty() const
{
    return values.empty();
}

void DepthMap::check() const
{
    if (empty())
        return;
    if (values.dims != 2 || (values.type() != CV_32FC1 && values.type() != CV_16UC1))
        CV_Error(Error::StsBadArg,
                 format("depth.values has %d dimensions and is of type %s; a matrix of type CV_32FC1 or CV_16UC1 is "
                        "expected",
                        values.dims, typeToString(values.type()).c_str()));
    if (camera != DEPTH_RAW && camera != DEPTH_CORRECTED)
        CV_Error(Error::StsBadArg, format("depth.camera is %d; DEPTH_RAW (%d) or DEPTH_CORRECTED (%d) is expected",
                                          camera, DEPTH_RAW, DEPTH_CORRECTED));
    if (kind != DEPTH_METRIC && kind != DEPTH_RELATIVE)
        CV_Error(Error::StsBadArg, format("depth.kind is %d; DEPTH_METRIC (%d) or DEPTH_RELATIVE (%d) is expected",
                                          kind, DEPTH_METRIC, DEPTH_RELATIVE));
    checkPositive(scale, "depth.scale");
    checkFinite(shift, "depth.shift");
}

}} // namespace cv::rsackermann
