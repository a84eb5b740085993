// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "precomp.hpp"
#include "relief.hpp"

namespace cv { namespace rsackermann {

// The cell that a place in it is in, and the weights of the control values along one axis.
static int splineWeights(double place, double low, double length, int controls, double weights[SplineWeights::ALONG])
{
    const int cells = controls - (SplineWeights::ALONG - 1);
    const double inside = (place - low) / length * cells;
    const double at = inside > 0 ? std::min(inside, double(cells)) : 0; // NaN too
    const int cell = std::min(int(at), cells - 1);
    const double f = at - cell, g = 1 - f;
    weights[0] = g * g * g / 6;
    weights[1] = (4 + 3 * f * f * (f - 2)) / 6;
    weights[2] = (4 + 3 * g * g * (g - 2)) / 6;
    weights[3] = f * f * f / 6;
    return cell;
}

SplineWeights::SplineWeights(const Rect2d& area, const Size& controls, const Point2d& place)
    : column(splineWeights(place.x, area.x, area.width, controls.width, x)),
      row(splineWeights(place.y, area.y, area.height, controls.height, y))
{
}

double Relief::at(const Vec3d& ray) const
{
    if (empty() || !(ray[2] > 0))
        return 0;
    const SplineWeights w(area, controls.size(), Point2d(ray[0] / ray[2], ray[1] / ray[2]));
    double sum = 0;
    for (int i = 0; i < SplineWeights::ALONG; i++)
    {
        const double* value = controls.ptr<double>(w.row + i) + w.column;
        sum += w.y[i] * (w.x[0] * value[0] + w.x[1] * value[1] + w.x[2] * value[2] + w.x[3] * value[3]);
    }
    return sum * ray[2];
}

}} // namespace cv::rsackermann
