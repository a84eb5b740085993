// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "../rectifier.hpp"
#include "map_kernels.hpp"
#include "maps.hpp"
#include "remap_limits.hpp"

namespace cv { namespace rsackermann {

namespace {

// An inverse-depth offset has an edge where its area ends, beyond which it doesn't change on that axis any more.
bool isSmoothAlong(double low, double high, int cells)
{
    const int most = 3; // of the cells in a patch, which its nodes and checks wouldn't notice if there were many
    return high <= 0 || low >= cells || (low >= 0 && high <= cells && high - low <= most);
}

// Fills tiles of a rectify map. On a plane the scaled inverse depth is a linear function of the pixel.
class TileRectifier CV_FINAL : public TileFiller
{
public:
    TileRectifier(const ShutterGeometry& shutter_, const Matx33d& matrix, int maxIterations, double tolerance)
        : shutter(shutter_),
          // The rate of a neighbour, by which the last step goes, is less exact where rows turn by a curve.
          forPixels(shutter_, maxIterations, (shutter_.hasCurve() ? 0.1 : 1) * tolerance),
          forPatches(shutter_, maxIterations, 0.3 * tolerance), inverse(matrix.inv()), upright(shutter_.up * inverse)
    {
        const double time0 = shutter.rowTime(Point2d(0, 0));
        timeSlope.x = (shutter.rowTime(Point2d(1, 0)) - time0) * shutter.lens.fx / matrix(0, 0);
        timeSlope.y = (shutter.rowTime(Point2d(0, 1)) - time0) * shutter.lens.fy / matrix(1, 1);

        const Scene& scene = shutter.scene;
        const Vec3d left(-scene.B, 0, scene.D),
            normals[PLANES] = {Vec3d(), left, -scene.lambda * left, Vec3d(0, scene.G, 0)};
        for (int i = 0; i < PLANES; i++)
        {
            const Vec3d w = scene.direction * (upright.t() * normals[i]);
            planes[i] = Bicubic(w[2], w[0], w[1]);
        }
    }

protected:
    bool fillByPatches(const Rect& square, MapWriter::Tile& tile) const CV_OVERRIDE
    {
        if (!isSmooth(square))
            return false;
        Bicubic visible[PLANES];
        MapPatch patches[PLANES];
        const int count = visiblePlanes(square, visible);
        for (int i = 0; i < count; i++)
            if (!fitPatch(square, visible[i], patches[i]))
                return false;
        evaluatePatches(patches, visible, count, tile.rowsOf(square));
        return true;
    }

    void fillByPixels(const Rect& area, MapWriter::Tile& tile) const CV_OVERRIDE
    {
        for (int y = area.y; y < area.br().y; y++)
        {
            Rectifier::Guess guess;
            for (int x = area.x; x < area.br().x; x++)
            {
                const Vec3d pixel(x, y, 1), b = upright * pixel;
                Point2d place;
                const bool exists = forPixels.solve(inverse * pixel, b, shutter.inverseDepth(b), true, guess, place);
                tile.set(Point(x, y), exists, place);
            }
        }
    }

private:
    enum { PLANES = Scene::PLANES };
    bool isSmooth(const Rect& square) const
    {
        if (!shutter.moving || shutter.depthOffset.empty())
            return true;
        Point2d low(DBL_MAX, DBL_MAX), high = -low;
        for (int k = 0; k < 4; k++)
        {
            const Point corner(square.x + k % 2 * square.width, square.y + k / 2 * square.height);
            const Vec3d ray = upright * Vec3d(corner.x, corner.y, 1);
            if (!(ray[2] > 0))
                return false;
            const Point2d cell = shutter.depthOffset.cellOf(ray);
            low = Point2d(std::min(low.x, cell.x), std::min(low.y, cell.y));
            high = Point2d(std::max(high.x, cell.x), std::max(high.y, cell.y));
        }
        const Size cells = shutter.depthOffset.cells();
        return isSmoothAlong(low.x, high.x, cells.width) && isSmoothAlong(low.y, high.y, cells.height);
    }

    // A linear function that is nowhere above another one at the corners of a square is nowhere above it in between.
    int visiblePlanes(const Rect& square, Bicubic visible[PLANES]) const
    {
        if (!shutter.moving)
        {
            visible[0] = planes[0];
            return 1;
        }
        Vec4d atCorners[PLANES];
        for (int i = 0; i < PLANES; i++)
            for (int k = 0; k < 4; k++)
            {
                const Point corner(square.x + k % 2 * square.width, square.y + k / 2 * square.height);
                atCorners[i][k] = planes[i].at(corner.x, corner.y);
            }
        int indices[PLANES];
        const int count = findVisible(atCorners, indices);
        for (int i = 0; i < count; i++)
        {
            visible[i] = planes[indices[i]];
            visible[i].c[0][0] = atCorners[indices[i]][0];
        }
        return count;
    }

    bool fitPatch(const Rect& square, const Bicubic& depth, MapPatch& patch) const
    {
        // First the first row and column of the places, then the last corner: they give the row times of the others.
        static const int order[MapPatch::NODES * MapPatch::NODES][2] = {{0, 0}, {3, 0}, {0, 3}, {3, 3}, {1, 0}, {2, 0},
                                                                        {0, 1}, {0, 2}, {1, 1}, {2, 1}, {3, 1}, {1, 2},
                                                                        {2, 2}, {3, 2}, {1, 3}, {2, 3}};
        const double step = square.width / (MapPatch::NODES - 1.);
        Rectifier::Guess guess;
        Point2d slope = timeSlope * step;
        double twist = 0, times[MapPatch::NODES][MapPatch::NODES];
        Point2d nodes[MapPatch::NODES][MapPatch::NODES];
        for (int k = 0; k < MapPatch::NODES * MapPatch::NODES; k++)
        {
            const int n = order[k][0], m = order[k][1];
            if (k == 1 || k == 2)
                guess.time = times[0][0] + n * slope.x + m * slope.y;
            else if (n > 0 && m > 0)
                guess.time = times[0][n] + times[m][0] - times[0][0] + n * m * twist;
            else if (k > 0)
                guess.time = n ? times[0][n - 1] + slope.x : times[m - 1][0] + slope.y;
            if (!solve(square, n * step, m * step, depth, guess, nodes[m][n]))
                return false;
            times[m][n] = guess.time;
            if (k == 1)
                slope.x = (times[0][3] - times[0][0]) / 3;
            else if (k == 2)
                slope.y = (times[3][0] - times[0][0]) / 3;
            else if (k == 3)
                twist = (times[3][3] - times[0][3] - times[3][0] + times[0][0]) / 9;
        }

        if (shutter.hasCurve())
        {
            const auto span = std::minmax_element(&times[0][0], &times[0][0] + MapPatch::NODES * MapPatch::NODES);
            if (!shutter.isSmoothBetween(*span.first, *span.second))
                return false;
        }
        patch = MapPatch(nodes, step);
        const int checks =
            shutter.depthOffset.empty() && !shutter.hasCurve() ? MapPatch::CHECKS : MapPatch::CHECKS_WITH_KNOTS;
        for (int i = 0; i < checks; i++)
        {
            const Point2d check = MapPatch::check(i, step), expected = patch.at(check.x, check.y);
            Point2d place;
            guess.time = shutter.rowTime(expected);
            if (!solve(square, check.x, check.y, depth, guess, place) ||
                !MapPatch::isNear(place, expected, shutter.hasCurve()))
                return false;
        }
        return true;
    }

    bool solve(const Rect& square, double column, double row, const Bicubic& depth, Rectifier::Guess& guess,
               Point2d& place) const
    {
        const Vec3d pixel(square.x + column, square.y + row, 1), b = upright * pixel;
        const double w = shutter.scene.direction * depth.at(column, row) + shutter.depthOffset.at(b);
        return forPatches.solve(inverse * pixel, b, w, true, guess, place) && isAddressable(place);
    }

    const ShutterGeometry& shutter;
    Rectifier forPixels, forPatches;
    Matx33d inverse;        // pixel of the global-shutter camera to ray
    Matx33d upright;        // pixel of the global-shutter camera to bearing
    Point2d timeSlope;      // row time per pixel of the global-shutter camera, but for motion and distortion
    Bicubic planes[PLANES]; // scaled inverse depths times the direction, relative to pixel (0, 0)
};

} // namespace

void fillRectifyMap(const ShutterGeometry& shutter, const Matx33d& matrix, const WarpMapGenerator::Params& params,
                    MapWriter& writer)
{
    fillTiles(TileRectifier(shutter, matrix, params.maxIterations, params.tolerance), writer);
}

}} // namespace cv::rsackermann
