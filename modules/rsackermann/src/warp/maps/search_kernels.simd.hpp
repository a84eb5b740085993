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
                    const Size& size, float* x, float* y, size_t step, Mat1b mask);
void findHidden(const DepthPatch& patch, const Point& first, const Mat1f& depths, float high, float distance,
                const Rect& block, const float* x, const float* y, size_t step, const Point2f& last, Mat1b mask);
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
                    const Size& size, float* x, float* y, size_t step, Mat1b mask)
{
    const PackDepths other(image);
    const PackVariable variable(patch.variable);
    for (int row = 0; row < size.height; row++, x += step, y += step)
    {
        const RowDepthPatch places(patch, first.y + row);
        for (int i = 0; i < size.width; i += Pack::COUNT)
        {
            const PackCurve curve(places, variable, columnsFrom(first.x + i));
            Pack depth;
            const Pack uncovered = SurfaceSearch<PackCurve, PackDepths>(other, curve, low, high).find(depth);
            const PackCurve::Place place = curve.at(depth);
            const int count = std::min(size.width - i, int(Pack::COUNT));
            storeFirst(place.x, count, x + i);
            storeFirst(place.y, count, y + i);
            if (!mask.empty())
                storeMask(uncovered > LARGEST_STRETCH, count, mask[row] + i);
        }
    }
}

void findHidden(const DepthPatch& patch, const Point& first, const Mat1f& depths, float high, float distance,
                const Rect& block, const float* x, const float* y, size_t step, const Point2f& last, Mat1b mask)
{
    const int iterations = 4; // to 0.03 pixels, which is near enough for a distance
    const PackDepths own(depths);
    const PackVariable variable(patch.variable);
    const FloatDepthPatch places(patch);
    for (int row = 0; row < block.height; row++, x += step, y += step)
        for (int i = 0; i < block.width; i += Pack::COUNT)
        {
            const int count = std::min(block.width - i, int(Pack::COUNT));
            const Pack placeX = loadFirst(x + i, count), placeY = loadFirst(y + i, count),
                       value = loadFirst(depths[block.y + row] + block.x + i, count),
                       outsideX = magnitude(placeX - 0.5f * last.x), outsideY = magnitude(placeY - 0.5f * last.y);
            // In front of the nearest pixels nothing is; those outside count as seen.
            const Pack low = choose(outsideX > 0.5f * last.x, high, choose(outsideY > 0.5f * last.y, high, value));
            const PackCurve curve(places, variable, placeX - float(first.x), placeY - float(first.y));
            Pack depth;
            SurfaceSearch<PackCurve, PackDepths>(own, curve, low, high).find(depth, iterations);
            const PackCurve::Place shown = curve.at(depth);
            const Pack awayX = magnitude(shown.x - (columnsFrom(block.x + i))),
                       awayY = magnitude(shown.y - float(block.y + row)), away = larger(awayX, awayY);
            storeMask(choose(low < high, away, 0.f) > distance, count, mask[row] + i);
        }
}

#endif // CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
