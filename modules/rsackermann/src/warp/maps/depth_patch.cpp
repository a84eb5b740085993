// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "depth_patch.hpp"

namespace cv { namespace rsackermann {

// Three places at equal steps of the inverse depth determine the quotient.
static double bendAt(const Point2d& pixel, double lowest, double highest, const DepthPlaces& places)
{
    const double step = (highest - lowest) / 2, smallest = 1; // pixels that the place moves
    Point2d p[3];
    for (int k = 0; k < 3; k++)
        if (!places.find(pixel, lowest + k * step, p[k]))
            return 0;
    const Point2d moved = p[2] - p[1], second = moved - (p[1] - p[0]);
    const bool byColumn = std::abs(moved.x) > std::abs(moved.y);
    if (!(std::max(std::abs(moved.x), std::abs(moved.y)) > smallest))
        return 0;
    // In lowest + (steps) the root is 1 / ratio steps away.
    const double ratio = (byColumn ? second.x / moved.x : second.y / moved.y) / 2, root = lowest + step / ratio;
    return ratio != 0 && (root < std::min(lowest, 0.) || root > 1.2 * std::max(highest, 0.)) ? 1 / root : 0;
}

DepthVariable::DepthVariable(const Point2d& pixel, double lowest, double highest, const DepthPlaces& places)
{
    // A range of a single value would have no scale.
    highest = std::max(highest, lowest + 1e-6 + 1e-3 * std::abs(lowest));
    const double root = bendAt(pixel, lowest, highest, places), from = lowest / (1 - root * lowest),
                 to = highest / (1 - root * highest);
    bend = float(root);
    low = float(from);
    scale = float((DepthPatch::NODES - 1) / (to - from));
}

// Between opposite corners.
static bool isSmooth(const Rect& square, double inverseDepth, const DepthPlaces& places)
{
    for (int k = 0; k < 2; k++)
    {
        const Point2d from(square.x + k * square.width, square.y), to(square.br().x - k * square.width, square.br().y);
        Point2d place, otherPlace;
        if (!places.find(from, inverseDepth, place) || !places.find(to, inverseDepth, otherPlace) ||
            !places.isSmoothBetween(from, place, to, otherPlace))
            return false;
    }
    return true;
}

bool DepthPatch::fit(const Rect& square, double lowest, double highest, const DepthPlaces& places)
{
    const double step = square.width / (NODES - 1.);
    const Point2d first = square.tl();
    variable = DepthVariable(first + 1.5 * step * Point2d(1, 1), lowest, highest, places);

    if (places.hasKnots() && !isSmooth(square, lowest, places))
        return false;
    double valuesX[NODES][NODES][NODES], valuesY[NODES][NODES][NODES]; // [power or depth][row][column]
    Rectifier::Guess guess;
    for (int m = 0; m < NODES; m++)
        for (int n = 0; n < NODES; n++)
        {
            Point2d p[NODES];
            for (int i = 0; i < NODES; i++)
            {
                const int k = n % 2 ? NODES - 1 - i : i; // on from where the last pixel ended
                if (!places.find(first + step * Point2d(n, m), variable.inverseDepth(k), p[k], guess))
                    return false;
            }
            Bicubic::interpolate(1, p[0].x, p[1].x, p[2].x, p[3].x);
            Bicubic::interpolate(1, p[0].y, p[1].y, p[2].y, p[3].y);
            for (int k = 0; k < NODES; k++)
            {
                valuesX[k][m][n] = p[k].x;
                valuesY[k][m][n] = p[k].y;
            }
        }
    for (int k = 0; k < NODES; k++)
    {
        x[k] = Bicubic(valuesX[k], step);
        y[k] = Bicubic(valuesY[k], step);
    }
    return isExact(first, step, places);
}

// At pixels and depths at which the error is nearly as large as anywhere (MapPatch::check).
bool DepthPatch::isExact(const Point2d& first, double step, const DepthPlaces& places) const
{
    const double depths[] = {0.38, 2.62};
    const int checks = places.hasKnots() ? MapPatch::CHECKS_WITH_KNOTS : MapPatch::CHECKS;
    Rectifier::Guess guess;
    for (int i = 0; i < checks * 2; i++)
    {
        const Point2d check = MapPatch::check(i / 2, step);
        const double depth = depths[i % 2];
        Point2d expected;
        if (!places.find(first + check, variable.inverseDepth(depth), expected, guess) ||
            !MapPatch::isNear(at(check, depth), expected, places.hasKnots()))
            return false;
    }
    return true;
}

Point2d DepthPatch::at(const Point2d& pixel, double depth) const
{
    Point2d place;
    for (int k = NODES - 1; k >= 0; k--)
        place = place * depth + Point2d(x[k].at(pixel.x, pixel.y), y[k].at(pixel.x, pixel.y));
    return place;
}

}} // namespace cv::rsackermann
