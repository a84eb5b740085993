// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "lens.hpp"
#include "rays.hpp"

namespace cv { namespace rsackermann {

void undistortedRays(const RollingShutterCamera& camera, const std::vector<Point2d>& raw, std::vector<Point2d>& rays)
{
    const Lens<double> lens(camera);
    rays.resize(raw.size());
    for (size_t i = 0; i < raw.size(); i++)
        unproject(lens, raw[i], rays[i]);
}

}} // namespace cv::rsackermann
