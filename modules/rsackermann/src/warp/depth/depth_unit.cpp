// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "../../camera/lens.hpp"
#include "../../motion/metric_way.hpp"
#include "../../scene/planes.hpp"
#include "../maps/maps.hpp"
#include "depth_unit.hpp"
#include "inverse_depth_image.hpp"

namespace cv { namespace rsackermann {

// A grid of pixels of the image that a depth belongs to.
static std::vector<Point> gridOf(const Size& size)
{
    const int across = 32, down = 24;
    std::vector<Point> pixels;
    for (int i = 0; i < down; i++)
        for (int j = 0; j < across; j++)
            pixels.push_back(Point((2 * j + 1) * size.width / (2 * across), (2 * i + 1) * size.height / (2 * down)));
    return pixels;
}

static std::vector<Point2d> raysOf(const RollingShutterCamera& camera, const WarpMapGenerator::Params& params,
                                   const DepthMap& depth, const std::vector<Point>& grid)
{
    const std::vector<Point2d> pixels(grid.begin(), grid.end());
    std::vector<Point2d> rays;
    if (depth.camera == DEPTH_RAW)
        undistortedRays(camera, pixels, rays);
    else
    {
        const Matx33d inverse = GlobalCamera(camera, params).matrix.inv();
        for (const Point2d& p : pixels)
        {
            const Vec3d ray = inverse * Vec3d(p.x, p.y, 1);
            rays.push_back(Point2d(ray[0], ray[1]));
        }
    }
    return rays;
}

bool isInAnotherUnit(const RollingShutterCamera& camera, const WarpMapGenerator::Params& params,
                     const AckermannMotion& motion, const DepthMap& depth)
{
    // Of centimetres it is 100; a wall's distance is less uncertain, and what stands before it isn't as near.
    const double ratioOfUnits = 20;
    if (depth.empty() || depth.kind != DEPTH_METRIC || motion.status != MOTION_OK || !isMetric(camera, motion))
        return false;
    const double way = wayPerUnitTime(camera, motion);
    const Matx33d up = motion.uprightRotation(camera);
    const Scene scene(motion);
    const GivenDepths given(depth, 0);
    const std::vector<Point> grid = gridOf(depth.values.size());
    const std::vector<Point2d> rays = raysOf(camera, params, depth, grid);
    std::vector<double> ratios; // of the given inverse depths to those of the planes
    for (size_t i = 0; i < grid.size(); i++)
    {
        float inverse;
        given.read(grid[i], 1, &inverse);
        const double plane = scene.inverseDepth(up * Vec3d(rays[i].x, rays[i].y, 1));
        if (inverse > 0 && plane * scene.direction > 0)
            ratios.push_back(inverse * way / plane);
    }
    if (ratios.empty())
        return false;
    std::nth_element(ratios.begin(), ratios.begin() + ratios.size() / 2, ratios.end());
    const double median = ratios[ratios.size() / 2];
    return median > ratioOfUnits || median * ratioOfUnits < 1;
}

}} // namespace cv::rsackermann
