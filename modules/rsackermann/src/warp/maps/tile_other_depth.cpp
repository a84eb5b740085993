// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "../depth/reach.hpp"
#include "../depth/surface_search.hpp"
#include "map_kernels.hpp"
#include "search_kernels.hpp"
#include "pixel_curve.hpp"
#include "maps.hpp"

namespace cv { namespace rsackermann {

namespace {

/* Fills tiles of a map from the depth in the other camera.
The places that a pixel may show lie on a curve in the other image, one for each depth. From the nearest depth on it is
followed to the first place at which the depth is that of the curve: this surface hides all behind it. Where the curve
passes between two surfaces without meeting one, no pixel of the other image shows the pixel; then it is mapped to the
surface behind (doc/theory.md, "Warp").
*/
class TileOtherDepth CV_FINAL : public TileFiller
{
public:
    TileOtherDepth(const DepthPlaces& places_, const InverseDepthImage& depths_) : places(places_), depths(depths_) {}

protected:
    bool fillByPatches(const Rect& square, MapWriter::Tile& tile) const CV_OVERRIDE
    {
        float low, high, stretch;
        DepthPatch patch;
        if (!depths.hasCells() || !findReach(places, depths, square.tl(), square.size(), low, high, stretch) ||
            !patch.fit(square, low, high, places))
            return false;
        fillBlock(patch, square.tl(), low, high, square & tile.area(), tile);
        return true;
    }

    void fillByPixels(const Rect& area, MapWriter::Tile& tile) const CV_OVERRIDE
    {
        for (int y = area.y; y < area.br().y; y++)
            for (int x = area.x; x < area.br().x; x++)
            {
                const Point pixel(x, y);
                float low, high, stretch, depth;
                Point2d place;
                if (!findReach(places, depths, pixel, Size(), low, high, stretch))
                {
                    tile.set(pixel, false);
                    continue;
                }
                const ExactCurve curve(places, pixel);
                if (SurfaceSearch<ExactCurve, InverseDepthImage>(depths, curve, low, high).find(depth) >
                    LARGEST_STRETCH)
                    tile.hide(pixel);
                const bool exists = places.find(pixel, depth, place);
                tile.set(pixel, exists, place);
            }
    }

private:
    // In a smaller part of a square fewer surfaces come into question.
    void fillBlock(const DepthPatch& patch, const Point& first, float low, float high, const Rect& block,
                   MapWriter::Tile& tile) const
    {
        const int smallest = 8;
        float stretch;
        narrowReach(patch, Rect(block.tl() - first, block.size()), depths, low, high, stretch);
        if (stretch <= LARGEST_STRETCH)
            searchDepthPatch(patch, depths.values(), 0.5f * (low + high), block.tl() - first, tile.at(block));
        else if (std::max(block.width, block.height) <= smallest)
        {
            Mat1b mask = tile.mask(block);
            searchSurfaces(patch, depths.values(), low, high, block.tl() - first, tile.at(block), mask);
        }
        else
            forEachQuarter(block, [&](const Rect& quarter) { fillBlock(patch, first, low, high, quarter, tile); });
    }

    const DepthPlaces& places;
    const InverseDepthImage& depths;
};

} // namespace

void fillByOtherDepth(const DepthPlaces& places, const InverseDepthImage& depths, MapWriter& writer)
{
    fillTiles(TileOtherDepth(places, depths), writer);
}

}} // namespace cv::rsackermann
