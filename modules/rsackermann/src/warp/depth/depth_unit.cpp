// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../../precomp.hpp"
#include "../../camera/lens.hpp"
#include "../../motion/metric_way.hpp"
#include "../../scene/planes.hpp"
#include "../maps/maps.hpp"
#include "inverse_depth_image.hpp"

namespace cv { namespace rsackermann {

// The first known pixel in each cell of a grid, and its inverse depth in 1/m.
static void findKnown(const DepthMap& depth, std::vector<Point2d>& pixels, std::vector<float>& inverseDepths)
{
    const int across = 32, down = 24, width = depth.values.cols, height = depth.values.rows;
    const GivenDepths given(depth, 0);
    std::vector<float> row(width);
    for (int cell = 0; cell < across * down; cell++)
    {
        const int i = cell / across, j = cell % across;
        const Range columns(j * width / across, (j + 1) * width / across);
        bool isFound = false;
        for (int y = i * height / down; y < (i + 1) * height / down && !isFound; y++)
        {
            given.read(Point(columns.start, y), columns.size(), row.data());
            const auto end = row.begin() + columns.size(),
                       known = std::find_if(row.begin(), end, [](float inverse) { return inverse > 0; });
            isFound = known != end;
            if (isFound)
            {
                pixels.push_back(Point2d(double(columns.start + (known - row.begin())), y));
                inverseDepths.push_back(*known);
            }
        }
    }
}

static std::vector<Vec3d> raysOf(const RollingShutterCamera& camera, const WarpMapGenerator::Params& params,
                                 const Matx33d& up, const DepthMap& depth, const std::vector<Point2d>& pixels)
{
    if (depth.camera == DEPTH_RAW)
        return bearingsOf(camera, up, pixels);
    const Matx33d toRay = up * GlobalCamera(camera, params).matrix.inv();
    std::vector<Vec3d> rays;
    for (const Point2d& p : pixels)
        rays.push_back(toRay * Vec3d(p.x, p.y, 1));
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
    std::vector<Point2d> pixels;
    std::vector<float> inverseDepths;
    findKnown(depth, pixels, inverseDepths);
    const std::vector<Vec3d> rays = raysOf(camera, params, up, depth, pixels);
    std::vector<double> ratios; // of the given inverse depths to those of the planes
    for (size_t i = 0; i < rays.size(); i++)
    {
        const double plane = scene.inverseDepth(rays[i]);
        if (plane * scene.direction > 0)
            ratios.push_back(inverseDepths[i] * way / plane);
    }
    if (ratios.empty())
        return false;
    std::nth_element(ratios.begin(), ratios.begin() + ratios.size() / 2, ratios.end());
    const double median = ratios[ratios.size() / 2];
    return median > ratioOfUnits || median * ratioOfUnits < 1;
}

}} // namespace cv::rsackermann
