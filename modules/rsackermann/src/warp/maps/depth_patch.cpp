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
    middle = float((from + to) / 2);
    scale = float(2 / (to - from));
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
    const Point2d first = square.tl();
    variable = DepthVariable(first + 0.5 * square.width * Point2d(1, 1), lowest, highest, places);

    if (places.hasKnots() && !isSmooth(square, lowest, places))
        return false;
    Rectifier::Guess guess;
    for (int power = 0; power < POWERS; power++)
        if (!add(power, first, square.width, places, guess))
            return false;
    return isExact(first, square.width / (NODES - 1.), places);
}

// Of a polynomial of degree 2, of which 3 x 3 values are given, the others of NODES x NODES.
static void extend(double values[DepthPatch::NODES][DepthPatch::NODES])
{
    for (int m = 0; m < 3; m++)
        values[m][3] = 3 * (values[m][2] - values[m][1]) + values[m][0];
    for (int n = 0; n < DepthPatch::NODES; n++)
        values[3][n] = 3 * (values[2][n] - values[1][n]) + values[0][n];
}

// Newton's interpolation: the next power accounts for what is left at a further depth.
bool DepthPatch::add(int power, const Point2d& first, double size, const DepthPlaces& places, Rectifier::Guess& guess)
{
    static const double depths[POWERS] = {0, 1, -1};
    const int count = degree(power) + 1;
    const double step = size / (count - 1), inverseDepth = variable.inverseDepth(depths[power]);
    double leftX[NODES][NODES], leftY[NODES][NODES]; // [row][column]
    for (int m = 0; m < count; m++)
        for (int i = 0; i < count; i++)
        {
            const int n = m % 2 ? count - 1 - i : i; // on from where the last row ended
            const Point2d pixel(n * step, m * step);
            Point2d place;
            if (!places.find(first + pixel, inverseDepth, place, guess))
                return false;
            const Point2d left = place - at(pixel, depths[power]);
            leftX[m][n] = left.x;
            leftY[m][n] = left.y;
        }
    if (count < NODES)
    {
        extend(leftX);
        extend(leftY);
    }
    const Bicubic more[] = {Bicubic(leftX, step), Bicubic(leftY, step)};
    Bicubic* const sums[] = {x, y};
    for (int k = 0; k < 2; k++)
        if (power < 2)
            sums[k][power].add(more[k], 1);
        else // v (v - 1) / 2, which vanishes at the depths before
        {
            sums[k][2].add(more[k], 0.5);
            sums[k][1].add(more[k], -0.5);
        }
    return true;
}

// At pixels and depths at which the error is nearly as large as anywhere (MapPatch::check).
bool DepthPatch::isExact(const Point2d& first, double step, const DepthPlaces& places) const
{
    const double depths[] = {-0.8, 0.8};
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
    for (int k = POWERS - 1; k >= 0; k--)
        place = place * depth + Point2d(x[k].at(pixel.x, pixel.y), y[k].at(pixel.x, pixel.y));
    return place;
}

}} // namespace cv::rsackermann
