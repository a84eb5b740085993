// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_WARP_MAPS_MAPS_HPP
#define OPENCV_RSACKERMANN_SRC_WARP_MAPS_MAPS_HPP

#include "opencv2/rsackermann/warp.hpp"
#include "opencv2/core/opencl/ocl_defs.hpp"
#include "map_writer.hpp"

namespace cv { namespace rsackermann {

class DepthPlaces;
class InverseDepthImage;
class InverseDepths;
class ShutterGeometry;
class Visibility;

//! Which image a map belongs to.
enum WarpDirection {
    WARP_RECTIFY, //!< the global-shutter image; its places are in the raw image
    WARP_DISTORT  //!< the raw image; its places are in the global-shutter image
};

//! The global-shutter camera as the parameters and the rolling-shutter camera determine it.
struct GlobalCamera
{
    GlobalCamera(const RollingShutterCamera& camera, const WarpMapGenerator::Params& params);

    Matx33d matrix;
    Size size;
};

//! Throws unless a depth is possible and has the size of its camera's image, or is empty.
void checkDepth(const DepthMap& depth, const RollingShutterCamera& camera, const WarpMapGenerator::Params& params);

/** Whether the values of a metric depth are evidently in another unit than DepthMap::scale says: walls and road of a
motion in metres are so much nearer or further away.

@param depth checked, or empty. */
bool isInAnotherUnit(const RollingShutterCamera& camera, const WarpMapGenerator::Params& params,
                     const AckermannMotion& motion, const DepthMap& depth);

//! For each pixel of one image the place in the other one.
void writeMap(WarpDirection warp, const RollingShutterCamera& camera, const WarpMapGenerator::Params& params,
              const AckermannMotion& motion, MapWriter& writer);

//! The same with a given depth, which is checked and isn't empty.
void writeDepthMap(WarpDirection warp, const RollingShutterCamera& camera, const WarpMapGenerator::Params& params,
                   const AckermannMotion& motion, const DepthMap& depth, MapWriter& writer);

/** The two maps of writeMap().
@param matrix camera matrix of the global-shutter camera. */
void fillRectifyMap(const ShutterGeometry& shutter, const Matx33d& matrix, const WarpMapGenerator::Params& params,
                    MapWriter& writer);
void fillDistortMap(const ShutterGeometry& shutter, const Matx33d& matrix, MapWriter& writer);

//! Fills a map of which each pixel's own depth is known. @param visibility null: of no interest.
void fillByOwnDepth(const DepthPlaces& places, const InverseDepths& depths, const Visibility* visibility,
                    MapWriter& writer);
//! Fills a map from the depth in the other camera.
void fillByOtherDepth(const DepthPlaces& places, const InverseDepthImage& depths, MapWriter& writer);

/** Fills tiles of a map (doc/theory.md, "Warp").

On each plane of the scene a map is smooth. A square of it is interpolated between 4 x 4 places for each plane that can
be seen in it, and every pixel takes the nearest plane. Further places in between show the error; a square in which it
is too large, or in which one of the places doesn't exist, is divided into quarters, and small ones are solved pixel by
pixel. The values of a square depend on its place alone: not on the size of the map, other tiles or the number of
threads.
*/
class TileFiller
{
public:
    virtual ~TileFiller() {}

    void fill(MapWriter::Tile& tile) const
    {
        fillSquare(Rect(tile.area().tl(), Size(MapWriter::TILE, MapWriter::TILE)), tile);
    }

protected:
    //! Fills what the tile has of a square; false if it can't be interpolated; it is undefined then.
    virtual bool fillByPatches(const Rect& square, MapWriter::Tile& tile) const = 0;
    virtual void fillByPixels(const Rect& area, MapWriter::Tile& tile) const = 0;

private:
    void fillSquare(const Rect& square, MapWriter::Tile& tile) const;
};

//! Calls use(quarter) for the four parts of a block of pixels that aren't empty.
template <class Use>
void forEachQuarter(const Rect& block, const Use& use)
{
    const Size half((block.width + 1) / 2, (block.height + 1) / 2);
    for (int k = 0; k < 4; k++)
    {
        const Rect quarter = Rect(block.tl() + Point(k % 2 * half.width, k / 2 * half.height), half) & block;
        if (!quarter.empty())
            use(quarter);
    }
}

//! Fills all tiles in parallel.
void fillTiles(const TileFiller& filler, MapWriter& writer);

#ifdef HAVE_OPENCL
/** Makes a map on an OpenCL device, in single precision; see WarpMapGenerator::initRectifyMap and initDistortMap.
@return false if the device can't; then nothing is promised about the outputs.
*/
bool oclWarpMap(WarpDirection warp, const RollingShutterCamera& camera, const WarpMapGenerator::Params& params,
                const AckermannMotion& motion, int m1type, OutputArray map1, OutputArray map2, OutputArray mask);
#endif

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_WARP_MAPS_MAPS_HPP
