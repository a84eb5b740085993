// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "inverse_depth_offset.hpp"

namespace cv { namespace rsackermann {

SplineWeights::Axis::Axis(double place, double low, double length, int controls)
{
    const int cells = controls - (ALONG - 1);
    const double inside = (place - low) / length * cells;
    const double at = inside > 0 ? std::min(inside, double(cells)) : 0; // NaN too
    first = std::min(int(at), cells - 1);
    const double f = at - first, g = 1 - f;
    weights[0] = g * g * g / 6;
    weights[1] = (4 + 3 * f * f * (f - 2)) / 6;
    weights[2] = (4 + 3 * g * g * (g - 2)) / 6;
    weights[3] = f * f * f / 6;
}

double InverseDepthOffset::at(const Vec3d& ray) const
{
    if (empty() || !(ray[2] > 0))
        return 0;
    const SplineWeights w(area, controls.size(), Point2d(ray[0] / ray[2], ray[1] / ray[2]));
    double sum = 0;
    for (int i = 0; i < SplineWeights::ALONG; i++)
    {
        const double *value = controls.ptr<double>(w.y.first + i) + w.x.first, *x = w.x.weights;
        sum += w.y.weights[i] * (x[0] * value[0] + x[1] * value[1] + x[2] * value[2] + x[3] * value[3]);
    }
    return sum * ray[2];
}

}} // namespace cv::rsackermann
