// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "distorter.hpp"
#include "maps.hpp"
#include "pixels.hpp"
#include "tile_rectifier.hpp"

namespace cv {
namespace rsackermann {

GlobalCamera::GlobalCamera(const RollingShutterCamera& camera, const WarpMapGenerator::Params& params)
    : matrix(params.newCameraMatrix == Matx33d::zeros() ? camera.cameraMatrix : params.newCameraMatrix),
      size(params.newSize == Size() ? camera.imageSize : params.newSize)
{
}

// parallel_for_ over rows, in stripes that are worth a thread.
namespace {

class RectifyTiles : public ParallelLoopBody
{
public:
    RectifyTiles(const TileRectifier& rectifier_, MapWriter& writer_) : rectifier(rectifier_), writer(writer_) {}

    void operator()(const Range& range) const CV_OVERRIDE
    {
        for (int i = range.start; i < range.end; i++)
        {
            MapWriter::Tile tile(writer, i);
            rectifier.fill(tile);
            tile.write();
        }
    }

private:
    const TileRectifier& rectifier;
    MapWriter& writer;
};

class DistortTiles : public ParallelLoopBody
{
public:
    DistortTiles(const Distorter& distorter_, const Matx33d& matrix_, MapWriter& writer_)
        : distorter(distorter_), matrix(matrix_), writer(writer_)
    {
    }

    void operator()(const Range& range) const CV_OVERRIDE
    {
        for (int i = range.start; i < range.end; i++)
        {
            MapWriter::Tile tile(writer, i);
            const Rect area = tile.area();
            for (int y = area.y; y < area.br().y; y++)
                for (int x = area.x; x < area.br().x; x++)
                {
                    Vec3d ray;
                    if (distorter.solve(Point2d(x, y), ray))
                        tile.set(Point(x, y), pixelOf(matrix, ray));
                    else
                        tile.setNone(Point(x, y));
                }
            tile.write();
        }
    }

private:
    const Distorter& distorter;
    const Matx33d& matrix;
    MapWriter& writer;
};

} // namespace

void writeRectifyMap(const RollingShutterCamera& camera, const WarpMapGenerator::Params& params, const AckermannMotion& motion,
                     MapWriter& writer)
{
    const Shutter shutter(camera, motion);
    const TileRectifier rectifier(shutter, GlobalCamera(camera, params).matrix, params.maxIterations, params.tolerance);
    parallel_for_(Range(0, writer.tiles()), RectifyTiles(rectifier, writer));
}

void writeDistortMap(const RollingShutterCamera& camera, const WarpMapGenerator::Params& params, const AckermannMotion& motion,
                     MapWriter& writer)
{
    const Shutter shutter(camera, motion);
    const Distorter distorter(shutter);
    const GlobalCamera global(camera, params);
    parallel_for_(Range(0, writer.tiles()), DistortTiles(distorter, global.matrix, writer));
}

}} // namespace cv::rsackermann
