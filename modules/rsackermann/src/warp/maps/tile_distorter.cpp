// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "../distorter.hpp"
#include "map_kernels.hpp"
#include "maps.hpp"
#include "remap_limits.hpp"

namespace cv { namespace rsackermann {

// The values at 0, 1/3, 2/3 and 1 become the Bernstein coefficients of the cubic through them.
static void toBernstein(double* v, int step)
{
    double &v1 = v[step], &v2 = v[2 * step];
    const double v0 = v[0], v3 = v[3 * step], b1 = (-5 * v0 + 18 * v1 - 9 * v2 + 2 * v3) / 6;
    v2 = (2 * v0 - 9 * v1 + 18 * v2 - 5 * v3) / 6;
    v1 = b1;
}

namespace {

// Fills tiles of a distort map. Where several planes can be seen their scaled inverse depths are interpolated as well.
class TileDistorter CV_FINAL : public TileFiller
{
public:
    TileDistorter(const ShutterGeometry& shutter_, const Matx33d& matrix_)
        : shutter(shutter_), distorter(shutter_), matrix(matrix_),
          checks(shutter_.hasCurve() ? MapPatch::CHECKS_WITH_KNOTS : MapPatch::CHECKS)
    {
    }

protected:
    bool fillByPatches(const Rect& square, MapWriter::Tile& tile) const CV_OVERRIDE
    {
        Nodes nodes;
        // Its depth isn't known before the place is.
        if (!shutter.depthOffset.empty() || !evaluate(square, nodes))
            return false;
        int visible[PLANES];
        const int count = visiblePlanes(nodes, visible);
        MapPatch patches[PLANES];
        Bicubic depths[PLANES];
        for (int i = 0; i < count; i++)
            if (!fitPatch(nodes, visible[i], patches[i]) || (count > 1 && !fitDepth(nodes, visible[i], depths[i])))
                return false;

        evaluatePatches(patches, depths, count, tile.rowsOf(square));
        return true;
    }

    void fillByPixels(const Rect& area, MapWriter::Tile& tile) const CV_OVERRIDE
    {
        for (int y = area.y; y < area.br().y; y++)
            for (int x = area.x; x < area.br().x; x++)
            {
                Vec3d ray;
                const bool exists = distorter.solve(Point2d(x, y), ray);
                tile.set(Point(x, y), exists, pixelOf(matrix, ray));
            }
    }

private:
    enum { PLANES = Scene::PLANES, NODES = MapPatch::NODES };

    // A pixel with the scaled inverse depths of all planes, times the direction: the largest is the nearest.
    struct Node
    {
        Distorter::View view;
        double depths[PLANES];
    };

    // The nodes of a square, and the pixels at which errors are measured.
    struct Nodes
    {
        double step;
        Node grid[NODES][NODES], checks[MapPatch::CHECKS_WITH_KNOTS];
    };
    bool evaluate(const Rect& square, Nodes& nodes) const
    {
        const Point2d first = square.tl();
        if (!shutter.isSmoothBetween(shutter.rowTime(first), shutter.rowTime(square.br())))
            return false;
        nodes.step = square.width / (NODES - 1.);
        for (int i = 0; i < NODES * NODES; i++)
            if (!evaluate(first + nodes.step * Point2d(Point(i % NODES, i / NODES)), nodes.grid[i / NODES][i % NODES]))
                return false;
        for (int i = 0; i < checks; i++)
            if (!evaluate(first + MapPatch::check(i, nodes.step), nodes.checks[i]))
                return false;
        return true;
    }

    bool evaluate(const Point2d& pixel, Node& node) const
    {
        if (!distorter.view(pixel, node.view))
            return false;
        shutter.scene.inverseDepths(node.view.direction, node.view.x, node.view.z, node.depths);
        for (int i = 0; i < PLANES; i++)
            node.depths[i] *= shutter.scene.direction;
        return true;
    }

    // A polynomial none of whose Bernstein coefficients is above that of another one is nowhere above it in the square.
    int visiblePlanes(const Nodes& nodes, int (&visible)[PLANES]) const
    {
        visible[0] = Scene::INFINITE;
        if (!shutter.moving)
            return 1;
        Vec<double, NODES * NODES> b[PLANES];
        for (int i = 0; i < PLANES; i++)
        {
            for (int k = 0; k < NODES * NODES; k++)
                b[i][k] = nodes.grid[k / NODES][k % NODES].depths[i];
            for (int m = 0; m < NODES; m++)
                toBernstein(&b[i][m * NODES], 1);
            for (int n = 0; n < NODES; n++)
                toBernstein(&b[i][n], NODES);
        }
        return findVisible(b, visible);
    }

    bool fitPatch(const Nodes& nodes, int plane, MapPatch& patch) const
    {
        Point2d places[NODES][NODES];
        for (int i = 0; i < NODES * NODES; i++)
        {
            const Node& node = nodes.grid[i / NODES][i % NODES];
            if (!place(node, node.depths[plane], places[i / NODES][i % NODES]))
                return false;
        }
        patch = MapPatch(places, nodes.step);
        for (int i = 0; i < checks; i++)
        {
            const Point2d check = MapPatch::check(i, nodes.step);
            Point2d expected;
            if (!place(nodes.checks[i], nodes.checks[i].depths[plane], expected) ||
                !MapPatch::isNear(patch.at(check.x, check.y), expected, shutter.hasCurve()))
                return false;
        }
        return true;
    }

    // An error of the depth counts by how much it moves the place: next to a crease a pixel may take the other plane.
    bool fitDepth(const Nodes& nodes, int plane, Bicubic& depth) const
    {
        double values[NODES][NODES];
        for (int i = 0; i < NODES * NODES; i++)
            values[i / NODES][i % NODES] = nodes.grid[i / NODES][i % NODES].depths[plane];
        depth = Bicubic(values, nodes.step);
        for (int i = 0; i < checks; i++)
        {
            const Point2d check = MapPatch::check(i, nodes.step);
            Point2d expected, got;
            if (!place(nodes.checks[i], nodes.checks[i].depths[plane], expected) ||
                !place(nodes.checks[i], depth.at(check.x, check.y), got) || !MapPatch::isNear(got, expected))
                return false;
        }
        return true;
    }

    bool place(const Node& node, double depth, Point2d& place) const
    {
        Vec3d ray;
        if (!distorter.rayTo(node.view, shutter.scene.direction * depth, ray))
            return false;
        place = pixelOf(matrix, ray);
        return isAddressable(place);
    }

    const ShutterGeometry& shutter;
    Distorter distorter;
    Matx33d matrix;
    int checks; // of MapPatch
};

} // namespace

void fillDistortMap(const ShutterGeometry& shutter, const Matx33d& matrix, MapWriter& writer)
{
    fillTiles(TileDistorter(shutter, matrix), writer);
}

}} // namespace cv::rsackermann
