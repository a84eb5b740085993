// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../calib.hpp"
#include "rays.hpp"

namespace cv {
namespace rsackermann {

void undistortedRays(const RollingShutterCamera& camera, const std::vector<Point2d>& raw, std::vector<Point2d>& rays)
{
    rays.resize(raw.size());
    if (raw.empty())
        return;
    if (camera.distCoeffs.empty() && camera.lensModel == LENS_PINHOLE)
    {
        const Matx33d& K = camera.cameraMatrix;
        for (size_t i = 0; i < raw.size(); i++)
            rays[i] = Point2d((raw[i].x - K(0, 2)) / K(0, 0), (raw[i].y - K(1, 2)) / K(1, 1));
    }
    else if (camera.lensModel == LENS_FISHEYE)
    {
        const std::vector<double> none(4, 0.);
        fisheye::undistortPoints(raw, rays, camera.cameraMatrix, camera.distCoeffs.empty() ? none : camera.distCoeffs);
    }
    else
    {
        // The default of five iterations leaves errors of whole pixels near the border of strongly distorted images.
        const TermCriteria criteria(TermCriteria::COUNT + TermCriteria::EPS, 100, 1e-12);
        undistortPoints(raw, rays, camera.cameraMatrix, camera.distCoeffs, noArray(), noArray(), criteria);
    }
}

}} // namespace cv::rsackermann
