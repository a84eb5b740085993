// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "map_kernels.hpp"
#include "../depth/visibility.hpp"
#include "maps.hpp"

namespace cv { namespace rsackermann {

namespace {

// Fills tiles of a map of which each pixel's own depth is known.
class TileOwnDepth CV_FINAL : public TileFiller
{
public:
    TileOwnDepth(const DepthPlaces& places_, const InverseDepths& depths_, const Visibility* visibility_)
        : places(places_), depths(depths_), visibility(visibility_)
    {
    }

protected:
    // If some depths aren't known the tile isn't of use.
    bool fillByPatches(const Rect& square, MapWriter::Tile& tile) const CV_OVERRIDE
    {
        const Rect seen = square & tile.area();
        float low, high;
        const Mat1f values = depths.part(seen, low, high);
        if (values.empty())
            return true;
        DepthPatch patch;
        if (!patch.fit(square, low, high, places))
            return false;
        evaluateDepthPatch(patch, values, tile.at(seen));
        if (visibility)
            visibility->find(patch, square.tl(), seen, tile);
        return true;
    }

    void fillByPixels(const Rect& area, MapWriter::Tile& tile) const CV_OVERRIDE
    {
        float low, high;
        const Mat1f values = depths.part(area, low, high);
        if (values.empty())
            return;
        for (int y = area.y; y < area.br().y; y++)
            for (int x = area.x; x < area.br().x; x++)
            {
                Point2d place;
                const bool exists = places.find(Point2d(x, y), values(Point(x, y) - area.tl()), place);
                tile.set(Point(x, y), exists, place);
            }
        if (visibility)
            visibility->findByPixels(area, tile);
    }

private:
    const DepthPlaces& places;
    const InverseDepths& depths;
    const Visibility* visibility;
};

} // namespace

void fillByOwnDepth(const DepthPlaces& places, const InverseDepths& depths, const Visibility* visibility,
                    MapWriter& writer)
{
    fillTiles(TileOwnDepth(places, depths, visibility), writer);
}

}} // namespace cv::rsackermann
