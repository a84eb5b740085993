// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "distorter.hpp"
#include "maps.hpp"
#include "pixels.hpp"
#include "rectifier.hpp"

namespace cv {
namespace rsackermann {

GlobalCamera::GlobalCamera(const RollingShutterCamera& camera, const WarpMapGenerator::Params& params)
    : matrix(params.newCameraMatrix == Matx33d::zeros() ? camera.cameraMatrix : params.newCameraMatrix),
      size(params.newSize == Size() ? camera.imageSize : params.newSize)
{
}

// parallel_for_ over rows, in stripes that are worth a thread.
static void forEachRow(const Size& size, const ParallelLoopBody& body)
{
    const double pixelsPerStripe = 1 << 14;
    parallel_for_(Range(0, size.height), body, std::max(1., size.area() / pixelsPerStripe));
}

namespace {

class RectifyRows : public ParallelLoopBody
{
public:
    RectifyRows(const Shutter& shutter_, const Rectifier& rectifier_, const Matx33d& matrix, MapWriter& writer_)
        : shutter(shutter_), rectifier(rectifier_), inverse(matrix.inv()), writer(writer_)
    {
    }

    void operator()(const Range& range) const CV_OVERRIDE
    {
        for (int y = range.start; y < range.end; y++)
        {
            MapWriter::Row row(writer, y);
            Rectifier::Guess guess;
            for (int x = 0; x < writer.size().width; x++)
            {
                const Vec3d ray = inverse * Vec3d(x, y, 1);
                const Vec3d b = shutter.up * ray;
                Point2d raw;
                if (rectifier.solve(ray, b, shutter.scene.inverseDepth(b), true, guess, raw))
                    row.set(x, raw);
                else
                    row.setNone(x);
            }
            row.write();
        }
    }

private:
    const Shutter& shutter;
    const Rectifier& rectifier;
    const Matx33d inverse;
    MapWriter& writer;
};

class DistortRows : public ParallelLoopBody
{
public:
    DistortRows(const Distorter& distorter_, const Matx33d& matrix_, MapWriter& writer_)
        : distorter(distorter_), matrix(matrix_), writer(writer_)
    {
    }

    void operator()(const Range& range) const CV_OVERRIDE
    {
        for (int y = range.start; y < range.end; y++)
        {
            MapWriter::Row row(writer, y);
            for (int x = 0; x < writer.size().width; x++)
            {
                Vec3d ray;
                if (distorter.solve(Point2d(x, y), ray))
                    row.set(x, pixelOf(matrix, ray));
                else
                    row.setNone(x);
            }
            row.write();
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
    const Rectifier rectifier(shutter, params.maxIterations, params.tolerance);
    forEachRow(writer.size(), RectifyRows(shutter, rectifier, GlobalCamera(camera, params).matrix, writer));
}

void writeDistortMap(const RollingShutterCamera& camera, const WarpMapGenerator::Params& params, const AckermannMotion& motion,
                     MapWriter& writer)
{
    const Shutter shutter(camera, motion);
    const Distorter distorter(shutter);
    const GlobalCamera global(camera, params);
    forEachRow(writer.size(), DistortRows(distorter, global.matrix, writer));
}

}} // namespace cv::rsackermann
