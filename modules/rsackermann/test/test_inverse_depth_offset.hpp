// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_TEST_INVERSE_DEPTH_OFFSET_HPP
#define OPENCV_RSACKERMANN_TEST_INVERSE_DEPTH_OFFSET_HPP

#include "opencv2/rsackermann/motion.hpp"

namespace opencv_test {

//! Value of the basis function of a B-spline with knots at whole numbers from first on, by the recursion of de Boor.
inline double basis(int first, int order, double at)
{
    if (order == 0)
        return at >= first && at < first + 1 ? 1 : 0;
    return (at - first) / order * basis(first, order - 1, at) +
           (first + order + 1 - at) / order * basis(first + 1, order - 1, at);
}

//! AckermannMotion::inverseDepthOffset as its documentation says.
inline double offsetAt(const AckermannMotion& motion, double x, double y)
{
    const Rect2d& area = motion.offsetArea;
    const int columns = motion.inverseDepthOffset.cols, rows = motion.inverseDepthOffset.rows;
    const double inside = 1e-12, // the last knot belongs to no cell
        u = std::min(std::max((x - area.x) / area.width, 0.), 1 - inside) * (columns - 3),
                 v = std::min(std::max((y - area.y) / area.height, 0.), 1 - inside) * (rows - 3);
    double sum = 0;
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < columns; j++)
            sum += motion.inverseDepthOffset.at<double>(i, j) * basis(j - 3, 3, u) * basis(i - 3, 3, v);
    return sum;
}

inline Vec3d bearingOf(const RollingShutterCamera& camera, const AckermannMotion& motion, const Point2d& pixel)
{
    return motion.uprightRotation(camera) * (camera.cameraMatrix.inv() * Vec3d(pixel.x, pixel.y, 1));
}

} // namespace opencv_test

#endif // OPENCV_RSACKERMANN_TEST_INVERSE_DEPTH_OFFSET_HPP
