// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../opencv_versions.hpp"
#include "../depth/surface_search.hpp"
#include "depth_patch.hpp"
#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY
#include "pack_depths.hpp"
#endif

namespace cv { namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

void searchSurfaces(const DepthPatch& patch, const Mat1f& depths, float low, float high, const Point& first,
                    const Coordinates& to, Mat1b& mask);
void findHidden(const DepthPatch& patch, const Point& first, const Mat1f& depths, float high, float distance,
                const Point& start, const Coordinates& shown, const Point2f& last, Mat1b& mask);
#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

namespace {

// Pixels for which a condition holds are hidden.
template <class Mask>
void storeMask(const Mask& isHidden, int count, uchar* to)
{
    float flags[Pack::COUNT];
    choose(isHidden, Pack(MASK_HIDDEN), Pack(MASK_SEEN)).store(flags);
    std::copy(flags, flags + count, to);
}

} // namespace

void searchSurfaces(const DepthPatch& patch, const Mat1f& image, float low, float high, const Point& first,
                    const Coordinates& to, Mat1b& mask)
{
    const PackDepths other(image);
    const PackVariable variable(patch.variable);
    for (int row = 0; row < to.size.height; row++)
    {
        const RowDepthPatch places(patch, first.y + row);
        for (int i = 0; i < to.size.width; i += Pack::COUNT)
        {
            const PackCurve curve(places, variable, columnsFrom(first.x + i));
            Pack depth;
            const Pack uncovered = SurfaceSearch<PackCurve, PackDepths>(other, curve, low, high).find(depth);
            const PackCurve::Place place = curve.at(depth);
            const int count = std::min(to.size.width - i, int(Pack::COUNT));
            storeFirst(place.x, count, to.x + row * to.step + i);
            storeFirst(place.y, count, to.y + row * to.step + i);
            if (!mask.empty())
                storeMask(uncovered > LARGEST_STRETCH, count, mask[row] + i);
        }
    }
}

void findHidden(const DepthPatch& patch, const Point& first, const Mat1f& depths, float high, float distance,
                const Point& start, const Coordinates& shown, const Point2f& last, Mat1b& mask)
{
    const int iterations = 4; // to 0.03 pixels, which is near enough for a distance
    const PackDepths own(depths);
    const PackVariable variable(patch.variable);
    const FloatDepthPatch places(patch);
    for (int row = 0; row < shown.size.height; row++)
        for (int i = 0; i < shown.size.width; i += Pack::COUNT)
        {
            const int count = std::min(shown.size.width - i, int(Pack::COUNT));
            const size_t at = row * shown.step + i;
            const Pack placeX = loadFirst(shown.x + at, count), placeY = loadFirst(shown.y + at, count),
                       value = loadFirst(depths[start.y + row] + start.x + i, count),
                       outsideX = magnitude(placeX - 0.5f * last.x), outsideY = magnitude(placeY - 0.5f * last.y);
            // In front of the nearest pixels nothing is; those outside count as seen.
            const Pack low = choose(outsideX > 0.5f * last.x, high, choose(outsideY > 0.5f * last.y, high, value));
            const PackCurve curve(places, variable, placeX - float(first.x), placeY - float(first.y));
            Pack depth;
            SurfaceSearch<PackCurve, PackDepths>(own, curve, low, high).find(depth, iterations);
            const PackCurve::Place found = curve.at(depth);
            const Pack awayX = magnitude(found.x - columnsFrom(start.x + i)),
                       awayY = magnitude(found.y - float(start.y + row)), away = larger(awayX, awayY);
            storeMask(choose(low < high, away, 0.f) > distance, count, mask[row] + i);
        }
}

#endif // CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
