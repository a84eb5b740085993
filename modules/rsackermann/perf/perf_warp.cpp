// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "perf_precomp.hpp"
#include "../test/test_box_depth.hpp"
#include "../test/test_lens_models.hpp"
#include "../test/test_metric_motion.hpp"

namespace opencv_test { namespace {

enum { PINHOLE_0, PINHOLE_5, PINHOLE_8, FISHEYE_4 };
CV_ENUM(MapType, CV_32FC1, CV_32FC2, CV_16SC2)
CV_ENUM(LensType, PINHOLE_0, PINHOLE_5, PINHOLE_8, FISHEYE_4)

RollingShutterCamera makeCamera(const Size& size, int lens)
{
    const double coefficients[] = {-0.28, 0.09, 8e-4, -6e-4, -0.012, 0.11, -0.04, 0.01};
    const int counts[] = {0, 5, 8, 4};
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(size, (lens == FISHEYE_4 ? 0.5 : 1.2) * size.width);
    camera.distCoeffs.assign(coefficients, coefficients + counts[lens]);
    if (lens == FISHEYE_4)
    {
        camera.lensModel = LENS_FISHEYE;
        camera.distCoeffs = std::vector<double>(4, -0.01);
    }
    camera.lineDelay = 0.4 / 30 / size.height;
    camera.height = 1.2;
    return camera;
}

AckermannMotion makeMotion(const RollingShutterCamera& camera)
{
    return motionFromMetric(camera, 0.6, 15, 2.5, 3, 0);
}

typedef TestBaseWithParam<tuple<Size, LensType, MapType>> Maps;

PERF_TEST_P(Maps, initRectifyMap,
            testing::Combine(testing::Values(szVGA, sz720p, sz1080p), LensType::all(), MapType::all()))
{
    const RollingShutterCamera camera = makeCamera(get<0>(GetParam()), get<1>(GetParam()));
    const AckermannMotion motion = makeMotion(camera);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    const int type = get<2>(GetParam());
    Mat map1, map2;
    generator->initRectifyMap(motion, map1, map2, type);
    declare.out(map1);
    TEST_CYCLE() generator->initRectifyMap(motion, map1, map2, type);
    SANITY_CHECK_NOTHING();
}

// What OpenCV needs for the lens alone: to compare with.
PERF_TEST_P(Maps, initUndistortRectifyMap,
            testing::Combine(testing::Values(szVGA, sz720p, sz1080p), testing::Values(PINHOLE_0, PINHOLE_5, PINHOLE_8),
                             testing::Values(CV_32FC1)))
{
    const RollingShutterCamera camera = makeCamera(get<0>(GetParam()), get<1>(GetParam()));
    const int type = get<2>(GetParam());
    Mat map1, map2;
    initUndistortRectifyMap(camera.cameraMatrix, camera.distCoeffs, noArray(), camera.cameraMatrix, camera.imageSize,
                            type, map1, map2);
    declare.out(map1, map2);
    TEST_CYCLE()
    initUndistortRectifyMap(camera.cameraMatrix, camera.distCoeffs, noArray(), camera.cameraMatrix, camera.imageSize,
                            type, map1, map2);
    SANITY_CHECK_NOTHING();
}

typedef TestBaseWithParam<tuple<Size, LensType>> Distort;

PERF_TEST_P(Distort, initDistortMap, testing::Combine(testing::Values(szVGA, sz1080p), LensType::all()))
{
    const RollingShutterCamera camera = makeCamera(get<0>(GetParam()), get<1>(GetParam()));
    const AckermannMotion motion = makeMotion(camera);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    Mat map1, map2;
    generator->initDistortMap(motion, map1, map2);
    declare.out(map1, map2);
    TEST_CYCLE() generator->initDistortMap(motion, map1, map2);
    SANITY_CHECK_NOTHING();
}

CV_ENUM(DepthOf, DEPTH_RAW, DEPTH_CORRECTED)
typedef TestBaseWithParam<tuple<Size, DepthOf, bool>> Depth; // and whether a mask is wanted

PERF_TEST_P(Depth, initRectifyMap, testing::Combine(testing::Values(szVGA, sz1080p), DepthOf::all(), testing::Bool()))
{
    const RollingShutterCamera camera = makeCamera(get<0>(GetParam()), PINHOLE_5);
    const AckermannMotion motion = makeMotion(camera);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    const DepthMap depth(makeBoxDepth(camera.imageSize), get<1>(GetParam()));
    Mat map1, map2, mask;
    const OutputArray maskWanted = get<2>(GetParam()) ? OutputArray(mask) : OutputArray(noArray());
    declare.in(depth.values);
    TEST_CYCLE() generator->initRectifyMap(motion, map1, map2, CV_32FC1, maskWanted, depth);
    SANITY_CHECK_NOTHING();
}

typedef TestBaseWithParam<tuple<int, LensType, bool>> Points; // number, lens, whether they are corrected or distorted

typedef void (WarpMapGenerator::*MovePoints)(const AckermannMotion&, InputArray, OutputArray, InputArray,
                                             OutputArray) const;

PERF_TEST_P(Points, move, testing::Combine(testing::Values(100, 2000), LensType::all(), testing::Bool()))
{
    const RollingShutterCamera camera = makeCamera(sz1080p, get<1>(GetParam()));
    const AckermannMotion motion = makeMotion(camera);
    const Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    const MovePoints move = get<2>(GetParam()) ? &WarpMapGenerator::correctPoints : &WarpMapGenerator::distortPoints;
    Mat points(get<0>(GetParam()), 2, CV_32F), moved;
    randu(points, 100, 900);
    declare.in(points);
    TEST_CYCLE() (*generator.*move)(motion, points, moved, noArray(), noArray());
    SANITY_CHECK_NOTHING();
}

}} // namespace opencv_test::
