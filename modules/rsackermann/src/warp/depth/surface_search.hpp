// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_DEPTH_SURFACE_SEARCH_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_DEPTH_SURFACE_SEARCH_HPP

#include "inverse_depth_image.hpp"

namespace cv { namespace rsackermann {

// Of one number what packs of them have (simd_pack.hpp).
inline float choose(bool condition, float a, float b)
{
    return condition ? a : b;
}
inline float smaller(float a, float b)
{
    return std::min(a, b);
}
inline float larger(float a, float b)
{
    return std::max(a, b);
}
inline float magnitude(float x)
{
    return std::abs(x);
}
inline float largest(float x)
{
    return x;
}
inline bool isAnyTrue(bool condition)
{
    return condition;
}

//! Pixels by which neighbours in the other image may be displaced against each other and be one surface: less than that
//! uncovers nothing.
static constexpr float LARGEST_STRETCH = 0.5f;

/** Follows the places that a pixel may show in the other image, from the nearest depth on, to the first one at which
the other image has the depth of the place (doc/theory.md, "Warp").
@tparam Places has the type Number, float or a pack of them for as many pixels, and at(inverseDepth) with x and y.
@tparam Depths has at(x, y, gap) as InverseDepthImage.
*/
template <class Places, class Depths>
class SurfaceSearch
{
public:
    typedef typename Places::Number Number;

    //! Each halves the step between two surfaces at least: 0.002 pixels are left.
    static const int ITERATIONS = 8;
    //! The first ones look where a straight surface would be met first; at an edge this is in vain.
    static const int CROSSINGS = 2;

    //! @param low, high inverse depths between which all surfaces are that the pixel could show.
    SurfaceSearch(const Depths& depths_, const Places& places_, const Number& low_, const Number& high_)
        : depths(depths_), places(places_), low(low_), high(high_)
    {
        const auto nearest = places.at(high), farthest = places.at(low);
        const Number x = magnitude(nearest.x - farthest.x), y = magnitude(nearest.y - farthest.y);
        length = larger(x, y);
        pixelsPerDepth = choose(low < high, length / (high - low), 0);
        gap = choose(pixelsPerDepth > 0, LARGEST_STRETCH / pixelsPerDepth, FLT_MAX);
    }

    /** Finds the inverse depth of what the pixel shows, or of the surface behind.
    @param iterations at most.
    @return 0, or by how many pixels the surfaces between which the curve passes are displaced against each other: if
    these are more than LARGEST_STRETCH the pixel isn't seen. */
    Number find(Number& depth, int iterations = ITERATIONS) const
    {
        Bracket between = {high, low, surfaceAt(high), surfaceAt(low)};
        nextBehind(between);
        Number error = FLT_MAX;
        depth = between.atFront;
        const auto look = [&](const Number& at) {
            const Number found = surfaceAt(at), isLeft = error;
            depth = choose(isLeft > TOLERANCE, found, depth);
            error = choose(isLeft > TOLERANCE, magnitude(found - at) * pixelsPerDepth, error);
            between.narrow(at, found);
        };
        for (int i = 0; i < iterations && isAnyTrue(error > TOLERANCE); i++)
        {
            if (i < CROSSINGS)
                look(between.crossing());
            if (isAnyTrue(error > TOLERANCE))
                look(0.5f * (between.front + between.back));
        }
        depth = choose(error > TOLERANCE, between.atFront, depth);
        return choose(error > TOLERANCE, (between.atBack - between.atFront) * pixelsPerDepth, 0);
    }

private:
    static constexpr float STEP = 0.5f, TOLERANCE = 1e-4f; // pixels
    static const int MOST_STEPS = 4096;

    Number surfaceAt(const Number& depth) const
    {
        const auto place = places.at(depth);
        return depths.at(place.x, place.y, gap);
    }

    // Depths of which front is before the surfaces and back at or behind the first of them, with the surfaces there.
    struct Bracket
    {
        Number front, back, atFront, atBack;

        void narrow(const Number& depth, const Number& surface)
        {
            const auto isBefore = surface < depth;
            front = choose(isBefore, depth, front);
            atFront = choose(isBefore, surface, atFront);
            back = choose(isBefore, back, depth);
            atBack = choose(isBefore, atBack, surface);
        }

        // Where a surface that is straight in between is met.
        Number crossing() const
        {
            const Number before = front - atFront, behind = atBack - back, both = before + behind;
            return choose(both > 0, back + (front - back) * (behind / both), back);
        }
    };

    // To a step apart.
    void nextBehind(Bracket& between) const
    {
        const float longest = largest(length);
        const int steps = longest < STEP * MOST_STEPS ? int(longest / STEP) : MOST_STEPS;
        Number middle = high;
        for (int i = 1; i <= steps && isAnyTrue(between.back < middle); i++)
        {
            middle = high + (low - high) * (float(i) / (steps + 1));
            const Number surface = surfaceAt(middle);
            const auto isOnWay = between.back < middle;
            Bracket next = between;
            next.narrow(middle, surface);
            between.front = choose(isOnWay, next.front, between.front);
            between.atFront = choose(isOnWay, next.atFront, between.atFront);
            between.back = choose(isOnWay, next.back, between.back);
            between.atBack = choose(isOnWay, next.atBack, between.atBack);
        }
    }

    const Depths& depths;
    const Places& places;
    Number low, high, length, pixelsPerDepth, gap;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_DEPTH_SURFACE_SEARCH_HPP
