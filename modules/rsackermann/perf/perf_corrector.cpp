// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "perf_precomp.hpp"
#include "../test/test_metric_motion.hpp"
#include "opencv2/imgproc.hpp"
#include "opencv2/opencv_modules.hpp"

namespace opencv_test { namespace {

//! Facades of windows to both sides of a road, as a moving camera with a rolling shutter sees them after some metres.
Mat streetImage(const RollingShutterCamera& camera, const AckermannMotion& motion, double travelled = 0)
{
    const Size size = camera.imageSize;
    const double f = camera.cameraMatrix(0, 0), cx = camera.cameraMatrix(0, 2), cy = camera.cameraMatrix(1, 2);
    Mat global(size, CV_8UC3, Scalar(200, 190, 180)), noise(size, CV_8UC3), map1, map2, raw;
    for (int side = -1; side <= 1; side += 2)
        for (double z = 40; z > 3; z -= 1.5)
            for (double y = -9; y < 1; y += 2.5)
            {
                const double x = side * 2.75;
                Point corners[4];
                for (int i = 0; i < 4; i++)
                {
                    const double depth = z - travelled - (i == 1 || i == 2 ? 1 : 0);
                    corners[i] = Point(cvRound(16 * (cx + f * x / depth)),
                                       cvRound(16 * (cy + f * (y + (i > 1 ? 1.8 : 0)) / depth)));
                }
                fillConvexPoly(global, corners, 4, Scalar(60, 70, 80), LINE_AA, 4);
            }
    randn(noise, 8, 4);
    global += noise;
    WarpMapGenerator::create(camera)->initDistortMap(motion, map1, map2);
    remap(global, raw, map1, map2, INTER_LINEAR);
    return raw;
}

typedef TestBaseWithParam<tuple<Size, int>> Corrector; // size, detector

PERF_TEST_P(Corrector, correct,
            testing::Combine(testing::Values(szVGA, sz720p, sz1080p),
                             testing::Values((int)DETECTOR_LSD, (int)DETECTOR_VERTICALS
#ifdef HAVE_OPENCV_XIMGPROC
                                             ,
                                             (int)DETECTOR_FLD, (int)DETECTOR_EDLINES
#endif
                                             )))
{
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(get<0>(GetParam()));
    camera.setRollPitch(0, 0);
    camera.lineDelay = 0.4 / 30 / camera.imageSize.height;
    camera.height = 1.2;
    const Mat src = streetImage(camera, motionFromMetric(camera, 0.6, 15, 2.75, 2.75, 0));
    RollingShutterCorrector::Params params;
    params.estimator.detector = get<1>(GetParam());
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera, params);
    Mat dst(src.size(), src.type());
    declare.in(src).out(dst);
    TEST_CYCLE() corrector->correct(src, dst);
    SANITY_CHECK_NOTHING();
}

// The frames of a drive, whose points are tracked.
typedef TestBaseWithParam<Size> Drive;

PERF_TEST_P(Drive, carried, testing::Values(szVGA, sz720p, sz1080p))
{
    const double seconds = 1 / 30., speed = 15;
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(GetParam());
    camera.setRollPitch(0, 0);
    camera.lineDelay = 0.4 * seconds / camera.imageSize.height;
    camera.height = 1.2;
    const AckermannMotion motion = motionFromMetric(camera, 0, speed, 2.75, 2.75, 0);
    const Mat frames[] = {streetImage(camera, motion), streetImage(camera, motion, speed * seconds)};
    RollingShutterCorrector::Params params;
    params.sequence = true;
    const Ptr<RollingShutterCorrector> corrector = RollingShutterCorrector::create(camera, params);
    Mat dst(frames[0].size(), frames[0].type());
    declare.in(frames[0], frames[1]).out(dst);
    int i = 0;
    TEST_CYCLE()
    {
        // To and fro: time may run backward.
        corrector->setTimestamp(i * seconds);
        corrector->correct(frames[i], dst);
        i = 1 - i;
    }
    SANITY_CHECK_NOTHING();
}

typedef TestBaseWithParam<tuple<Size, int>> Detect; // size, detector

PERF_TEST_P(Detect, detectSegments,
            testing::Combine(testing::Values(szVGA, sz720p, sz1080p),
                             testing::Values((int)DETECTOR_LSD, (int)DETECTOR_VERTICALS
#ifdef HAVE_OPENCV_XIMGPROC
                                             ,
                                             (int)DETECTOR_FLD, (int)DETECTOR_EDLINES
#endif
                                             )))
{
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(get<0>(GetParam()));
    const Mat src = streetImage(camera, AckermannMotion());
    const int detector = get<1>(GetParam());
    Mat segments;
    declare.in(src);
    TEST_CYCLE() detectSegments(src, segments, detector);
    SANITY_CHECK_NOTHING();
}

}} // namespace opencv_test::
