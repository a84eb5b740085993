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
    DepthPlaces::Guess guess;
    for (int k = 0; k < 3; k++)
        if (!places.find(pixel, lowest + k * step, p[k], guess))
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
    middle = float((from + to) / 2);
    scale = float(2 / (to - from));
}

bool DepthVariable::coefficients(const Point2d& pixel, const DepthPlaces& places, DepthPlaces::Guess& guess,
                                 Point2d (&c)[POWERS]) const
{
    Point2d p[POWERS];
    for (int k = 0; k < POWERS; k++)
        if (!places.find(pixel, inverseDepth(k - 1), p[k], guess))
            return false;
    c[0] = p[1];
    c[1] = (p[2] - p[0]) / 2;
    c[2] = (p[2] + p[0]) / 2 - p[1];
    return true;
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

bool DepthPatch::fit(const Rect& square, double lowest, double highest, const DepthPlaces& places, double times)
{
    const Point2d first = square.tl();
    variable = DepthVariable(first + 0.5 * square.width * Point2d(1, 1), lowest, highest, places);

    if (places.hasKnots() && !isSmooth(square, lowest, places))
        return false;
    return interpolate(first, square.width, places) && isExact(first, square.width / (NODES - 1.), places, times);
}

bool DepthPatch::interpolate(const Point2d& first, double size, const DepthPlaces& places)
{
    const double step = size / (NODES - 1);
    double valuesX[POWERS][NODES][NODES], valuesY[POWERS][NODES][NODES]; // [power][row][column]
    DepthPlaces::Guess guess;
    for (int m = 0; m < NODES; m++)
        for (int i = 0; i < NODES; i++)
        {
            const int n = m % 2 ? NODES - 1 - i : i; // on from where the last row ended
            Point2d c[POWERS];
            if (!variable.coefficients(first + Point2d(n * step, m * step), places, guess, c))
                return false;
            for (int k = 0; k < POWERS; k++)
            {
                valuesX[k][m][n] = c[k].x;
                valuesY[k][m][n] = c[k].y;
            }
        }
    for (int k = 0; k < POWERS; k++)
    {
        x[k] = Bicubic(valuesX[k], step);
        y[k] = Bicubic(valuesY[k], step);
    }
    return true;
}

// At pixels and depths at which the error is nearly as large as anywhere (MapPatch::check).
bool DepthPatch::isExact(const Point2d& first, double step, const DepthPlaces& places, double times) const
{
    const double depths[] = {-0.8, 0.8};
    const int checks = places.hasKnots() ? MapPatch::CHECKS_WITH_KNOTS : MapPatch::CHECKS;
    DepthPlaces::Guess guess;
    for (int i = 0; i < checks * 2; i++)
    {
        const Point2d check = MapPatch::check(i / 2, step);
        const double depth = depths[i % 2];
        Point2d expected;
        if (!places.find(first + check, variable.inverseDepth(depth), expected, guess) ||
            !MapPatch::isNear(at(check, depth), expected, places.hasKnots(), times))
            return false;
    }
    return true;
}

Point2d DepthPatch::at(const Point2d& pixel, double depth) const
{
    Point2d place;
    for (int k = POWERS - 1; k >= 0; k--)
        place = place * depth + Point2d(x[k].at(pixel.x, pixel.y), y[k].at(pixel.x, pixel.y));
    return place;
}

}} // namespace cv::rsackermann
