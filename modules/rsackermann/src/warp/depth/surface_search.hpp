// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_DEPTH_SURFACE_SEARCH_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_DEPTH_SURFACE_SEARCH_HPP

#include "inverse_depth_image.hpp"

namespace cv { namespace rsackermann {

/** Follows the places that a pixel may show in the other image, from the nearest depth on, to the first one at which
the other image has the depth of the place (doc/theory.md, "Warp").

Neighbouring pixels of the other image are one surface unless their depths displace them by more than half a pixel
against each other: less than that uncovers nothing.
@tparam Places has Point2f at(float inverseDepth) const.
*/
template <class Places>
class SurfaceSearch
{
public:
    //! @param low, high inverse depths between which all surfaces are that the pixel could show.
    SurfaceSearch(const InverseDepthImage& depths_, const Places& places_, float low_, float high_)
        : depths(depths_), places(places_), low(low_), high(high_)
    {
        const Point2f way = places.at(high) - places.at(low);
        length = std::max(std::abs(way.x), std::abs(way.y));
        pixelsPerDepth = high > low ? length / (high - low) : 0;
        gap = pixelsPerDepth > 0 ? LARGEST_STRETCH / pixelsPerDepth : FLT_MAX;
    }

    //! The inverse depth of what the pixel shows, or of the surface behind; false if it isn't seen.
    bool find(float& depth) const
    {
        float front = high, back;
        nextBehind(front, back);
        for (int i = 0; i < ITERATIONS; i++)
        {
            const float middle = 0.5f * (front + back), value = surfaceAt(middle);
            const float next = std::min(std::max(value, back), front), again = surfaceAt(next);
            if (std::abs(again - next) * pixelsPerDepth <= TOLERANCE)
            {
                depth = again;
                return true;
            }
            narrow(middle, value, front, back);
            narrow(next, again, front, back);
        }
        depth = surfaceAt(front);
        return (surfaceAt(back) - depth) * pixelsPerDepth <= LARGEST_STRETCH;
    }

    //! Pixels; curves that aren't longer meet one surface only.
    static float largestStretch() { return LARGEST_STRETCH; }

private:
    static constexpr float LARGEST_STRETCH = 0.5f, STEP = 0.5f, TOLERANCE = 1e-5f; // pixels
    static const int ITERATIONS = 24, MOST_STEPS = 4096;

    float surfaceAt(float depth) const
    {
        const Point2f place = places.at(depth);
        return depths.at(place.x, place.y, gap);
    }

    // Front is before the surfaces, back at or behind the first of them, a step apart.
    void nextBehind(float& front, float& back) const
    {
        const int steps = length < STEP * MOST_STEPS ? int(length / STEP) : MOST_STEPS;
        for (int i = 1; i <= steps; i++)
        {
            back = high + (low - high) * i / (steps + 1);
            if (surfaceAt(back) >= back)
                return;
            front = back;
        }
        back = low;
    }

    static void narrow(float depth, float surface, float& front, float& back)
    {
        if (surface < depth)
            front = std::min(front, depth);
        else
            back = std::max(back, depth);
    }

    const InverseDepthImage& depths;
    const Places& places;
    float low, high, length, pixelsPerDepth, gap;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_DEPTH_SURFACE_SEARCH_HPP
