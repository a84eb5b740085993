// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "test_precomp.hpp"
#include "test_symmetry.hpp"
#include "test_warp_cameras.hpp"
#include <functional>

// Whatever a motion is applied to, in each mode: the mirror image, the reversed drive and a camera that is mounted
// otherwise have the same result.

namespace opencv_test { namespace {

struct Setting
{
    RollingShutterCamera camera;
    MetricMotion metric;
    AckermannMotion motion;
    WarpMapGenerator::Params params;
};

struct Mode
{
    const char* name;
    std::function<void(Setting&)> ofCamera, ofMotion;
};

void keep(Setting&) {}

const Mode MODES[] = {{"forward", keep, keep},
                      {"reverse", [](Setting& s) { s.metric.speed = -9; }, keep},
                      {"left turn", [](Setting& s) { s.metric.yawRate = -0.9; }, keep},
                      {"left wall", [](Setting& s) { s.metric.rightDistance = 0; }, keep},
                      {"right wall", [](Setting& s) { s.metric.leftDistance = 0; }, keep},
                      {"road alone", [](Setting& s) { s.metric.leftDistance = s.metric.rightDistance = 0; },
                       [](Setting& s) { s.motion.scale = SCALE_ROAD; }},
                      {"turn alone", [](Setting& s) { s.metric.speed = 0; }, keep},
                      {"looks left",
                       [](Setting& s) {
                           s.camera.heading = CV_PI / 2 - 0.1;
                           s.metric.wallDirection = s.camera.heading + 0.05;
                       },
                       keep},
                      {"looks back", [](Setting& s) { s.metric.wallDirection = s.camera.heading = CV_PI - 0.1; }, keep},
                      {"columns",
                       [](Setting& s) {
                           s.camera.scanDirection = SCAN_LEFT_TO_RIGHT;
                           s.camera.referenceRow = 24;
                       },
                       keep},
                      {"last row", [](Setting& s) { s.camera.referenceRow = s.camera.imageSize.height - 1; }, keep},
                      {"fisheye",
                       [](Setting& s) {
                           s.camera.lensModel = LENS_FISHEYE;
                           s.camera.distCoeffs = {-0.03, 0.012, -0.006, 0.001};
                       },
                       keep},
                      {"sensor tilted about x",
                       [](Setting& s) {
                           s.camera.distCoeffs = lensCamera(BROWN_14).distCoeffs;
                           s.camera.distCoeffs[13] = 0;
                       },
                       keep},
                      {"sensor tilted about y",
                       [](Setting& s) {
                           s.camera.distCoeffs = lensCamera(BROWN_14).distCoeffs;
                           s.camera.distCoeffs[12] = 0;
                       },
                       keep},
                      {"new camera",
                       [](Setting& s) {
                           s.params.newCameraMatrix = Matx33d(172, 0, 110, 0, 166, 66, 0, 0, 1);
                           s.params.newSize = Size(225, 161);
                       },
                       keep},
                      {"rolls and pitches", keep,
                       [](Setting& s) {
                           s.motion.pitchRate = 0.05;
                           s.motion.rollRate = -0.07;
                           s.motion.rollCorrection = 0.02;
                           s.motion.pitchCorrection = -0.03;
                       }},
                      {"curve", keep,
                       [](Setting& s) {
                           RNG rng(3);
                           addRotationCurve(s.motion, 5, rng);
                       }},
                      {"offset", keep, [](Setting& s) {
                           s.motion.inverseDepthOffset =
                               (Mat_<double>(4, 5) << 1, 2, 0, -1, 3, 0, 2, 3, -2, 1, 1, 0, 2, 0, -1, 2, 1, 1, 3, 0);
                           s.motion.inverseDepthOffset *= 0.01;
                           s.motion.offsetArea = Rect2d(-0.3, -0.2, 0.7, 0.5);
                       }}};

Setting settingOf(const Mode& mode)
{
    Setting s;
    s.camera = RollingShutterCamera(Size(193, 129), Matx33d(180, 0, 90, 0, 186, 69, 0, 0, 1));
    s.camera.distCoeffs = {-0.1, 0.02, 1e-3, -2e-3};
    s.camera.lineDelay = 250e-6;
    s.camera.referenceRow = 40;
    s.camera.height = 1.3;
    s.camera.heading = 0.1;
    s.camera.setRollPitch(0.04, 0.06);
    s.metric.yawRate = 0.7;
    s.metric.speed = 15;
    s.metric.leftDistance = 2.5;
    s.metric.rightDistance = 3.5;
    s.metric.wallDirection = 0.12;
    s.params.tolerance = 1e-4;
    s.params.maxIterations = 30;
    mode.ofCamera(s);
    s.motion = AckermannMotion::fromMetric(s.camera, s.metric);
    for (int i = 0; i < 16; i++) // positive definite
        s.motion.covariance.val[i] = i % 5 == 0 ? 1e-4 * (1 + i) : 1e-5 * (i / 4 + i % 4);
    mode.ofMotion(s);
    return s;
}

Setting twinOf(const Setting& s, const Twin& twin)
{
    Setting t = s;
    t.camera = twin.of(s.camera);
    t.motion = twin.of(s.motion, s.camera);
    t.params.newCameraMatrix = twin.of(s.params.newCameraMatrix, s.params.newSize);
    t.params.newSize = twin.of(s.params.newSize);
    return t;
}

Size newSizeOf(const Setting& s)
{
    return s.params.newSize.empty() ? s.camera.imageSize : s.params.newSize;
}

//! Boxes and bars with steep edges in every direction. What fills holes goes by squares of pixels, which mirrors move.
DepthMap boxes(const Size& size, int ofCamera, int kind, bool hasHoles)
{
    Mat1f values(size);
    for (int y = 0; y < size.height; y++)
        for (int x = 0; x < size.width; x++)
            values(y, x) = 12 - 0.017f * x - 0.033f * y;
    values(Rect(18, 12, 30, 50)).setTo(4);
    values(Rect(72, 60, 90, 7)).setTo(2.5);
    if (hasHoles)
    {
        values(Rect(120, 18, 10, 36)).setTo(0);
        values(Rect(36, 90, 90, 24)).setTo(0);
    }
    if (kind == DEPTH_METRIC)
        return DepthMap(values, ofCamera);
    Mat inverse = 1 / values;
    inverse.setTo(std::numeric_limits<float>::quiet_NaN(), values == 0);
    DepthMap relative(inverse, ofCamera, 0.7, kind);
    relative.shift = 0.01;
    return relative;
}

//! Nearly all places are the same; edges may fall to either side.
void expectSamePlaces(const Mat& expected, const Mat& got)
{
    ASSERT_EQ(expected.size(), got.size());
    const Mat differ = cv::abs(expected - got) > 2e-3;
    EXPECT_LE(countNonZero(differ), 2e-3 * got.total());
}

typedef testing::TestWithParam<int> WarpSymmetry; // index of MODES

TEST_P(WarpSymmetry, of_maps)
{
    const Setting s = settingOf(MODES[GetParam()]);
    SCOPED_TRACE(MODES[GetParam()].name);
    for (const Twin& twin : {MIRRORED, REVERSED, ON_ITS_SIDE})
    {
        const Setting t = twinOf(s, twin);
        const Ptr<WarpMapGenerator> one = WarpMapGenerator::create(s.camera, s.params),
                                    other = WarpMapGenerator::create(t.camera, t.params);
        for (const bool distort : {false, true})
            for (int kind = -1; kind < 4; kind++)
            {
                SCOPED_TRACE(testing::Message() << twin << " distort " << distort << " depth " << kind);
                const int ofCamera = kind % 2 ? DEPTH_CORRECTED : DEPTH_RAW;
                DepthMap depth;
                if (kind >= 0)
                    depth = boxes(ofCamera == DEPTH_RAW ? s.camera.imageSize : newSizeOf(s), ofCamera,
                                  kind < 2 ? DEPTH_METRIC : DEPTH_RELATIVE, twin.reversed);
                const DepthMap twinDepth = twin.of(depth, s.camera);
                Mat x, y, mask, twinX, twinY, twinMask;
                if (distort)
                {
                    one->initDistortMap(s.motion, x, y, CV_32FC1, mask, depth);
                    other->initDistortMap(t.motion, twinX, twinY, CV_32FC1, twinMask, twinDepth);
                }
                else
                {
                    one->initRectifyMap(s.motion, x, y, CV_32FC1, mask, depth);
                    other->initRectifyMap(t.motion, twinX, twinY, CV_32FC1, twinMask, twinDepth);
                }
                twin.ofMaps(x, y, distort ? newSizeOf(s) : s.camera.imageSize);
                expectSamePlaces(x, twinX);
                expectSamePlaces(y, twinY);
                EXPECT_LE(countNonZero(twin.ofImage(mask) != twinMask), 2e-3 * mask.total());
                EXPECT_GT(countNonZero(mask == MASK_SEEN), 0);
            }
        EXPECT_EQ(twin.of(one->validRoi(s.motion).size()), other->validRoi(t.motion).size());
        const Matx33d matrix = twin.of(one->optimalNewCameraMatrix(s.motion, 0.5), newSizeOf(s));
        EXPECT_LT(cv::norm(matrix, other->optimalNewCameraMatrix(t.motion, 0.5)), 0.1);
    }
}

TEST_P(WarpSymmetry, of_points_and_poses)
{
    const Setting s = settingOf(MODES[GetParam()]);
    SCOPED_TRACE(MODES[GetParam()].name);
    RNG rng(5);
    Mat places(400, 2, CV_64F), depths(400, 1, CV_64F);
    rng.fill(places, RNG::UNIFORM, 0, 128);
    rng.fill(depths, RNG::UNIFORM, -2, 20); // some aren't known
    for (const Twin& twin : {MIRRORED, REVERSED, ON_ITS_SIDE})
    {
        SCOPED_TRACE(testing::Message() << twin);
        const Setting t = twinOf(s, twin);
        const Ptr<WarpMapGenerator> one = WarpMapGenerator::create(s.camera, s.params),
                                    other = WarpMapGenerator::create(t.camera, t.params);
        for (const bool areKnown : {false, true})
        {
            const Mat given = areKnown ? depths : Mat();
            const Size raw = s.camera.imageSize, corrected = newSizeOf(s);
            Mat points, twinPoints;
            one->correctPoints(s.motion, places, points, given);
            other->correctPoints(t.motion, twin.ofPlaces(places, raw), twinPoints, given);
            Mat expected = twin.ofPlaces(points, corrected);
            expected.setTo(-16384, points == -16384);
            expectSamePlaces(expected, twinPoints);
            one->distortPoints(s.motion, places, points, given);
            other->distortPoints(t.motion, twin.ofPlaces(places, corrected), twinPoints, given);
            expected = twin.ofPlaces(points, raw);
            expected.setTo(-16384, points == -16384);
            expectSamePlaces(expected, twinPoints);
        }
        for (int i = 0; i < 10; i++)
        {
            const Mat place = places.row(i), twinPlace = twin.ofPlaces(place, s.camera.imageSize);
            Matx33d R, twinR;
            Vec3d T, twinT;
            s.motion.pose(s.camera, s.camera.rowTime(Point2d(place.at<double>(0), place.at<double>(1))), R, T);
            t.motion.pose(t.camera, t.camera.rowTime(Point2d(twinPlace.at<double>(0), twinPlace.at<double>(1))), twinR,
                          twinT);
            twin.ofPose(s.camera, R, T);
            EXPECT_LT(cv::norm(R, twinR), 1e-12);
            EXPECT_LT(cv::norm(T, twinT), 1e-12);
        }
    }
}

// Yaw rate, speed, delta and wall ratio, and how well they are known.
TEST_P(WarpSymmetry, of_metric_values)
{
    const Setting s = settingOf(MODES[GetParam()]);
    SCOPED_TRACE(MODES[GetParam()].name);
    for (const Twin& twin : {MIRRORED, REVERSED, ON_ITS_SIDE})
    {
        SCOPED_TRACE(testing::Message() << twin);
        const Setting t = twinOf(s, twin);
        const double mirror = twin.mirrored ? -1 : 1, reverse = twin.reversed ? -1 : 1;
        double yawRate, speed, twinYawRate, twinSpeed;
        s.motion.yawRate(s.camera, yawRate);
        t.motion.yawRate(t.camera, twinYawRate);
        EXPECT_EQ(s.motion.speed(s.camera, speed), t.motion.speed(t.camera, twinSpeed));
        EXPECT_NEAR(mirror * reverse * yawRate, twinYawRate, 1e-12);
        EXPECT_NEAR(reverse * speed, twinSpeed, 1e-9);
        EXPECT_NEAR(mirror * s.motion.delta(), t.motion.delta(), 1e-12);
        const double ratio = s.motion.wallRatio;
        if (twin.mirrored && ratio > 0)
            continue; // the speed would be that of the other wall's distance
        const Matx44d J = Matx44d::diag(Vec4d(mirror * reverse, reverse, mirror, 1)),
                      expected = J * s.motion.metricCovariance(s.camera) * J;
        EXPECT_LT(cv::norm(expected, t.motion.metricCovariance(t.camera)), 1e-9 * cv::norm(expected) + 1e-12);
    }
}

TEST_P(WarpSymmetry, of_drawings)
{
    const Setting s = settingOf(MODES[GetParam()]);
    SCOPED_TRACE(MODES[GetParam()].name);
    const Mat segments = (Mat_<float>(2, 4) << 24, 18, 27, 72, 150, 12, 147, 84);
    const std::vector<uchar> labels = {SEGMENT_LEFT_WALL, SEGMENT_RIGHT_WALL};
    std::vector<uchar> twinLabels = labels;
    for (const Twin& twin : {MIRRORED, REVERSED, ON_ITS_SIDE})
    {
        SCOPED_TRACE(testing::Message() << twin);
        const Setting t = twinOf(s, twin);
        // The only wall is called the left one.
        const bool isOther = twin.mirrored && s.motion.wallRatio > 0;
        for (int i = 0; i < 2; i++)
            twinLabels[i] = labels[isOther ? 1 - i : i];
        Mat image(s.camera.imageSize, CV_8UC3, Scalar::all(0)), other(t.camera.imageSize, CV_8UC3, Scalar::all(0));
        drawMotion(image, segments, labels, s.camera, s.motion, 3);
        drawMotion(other, twin.ofPlaces(segments, s.camera.imageSize), twinLabels, t.camera, t.motion, 3);
        // Lines aren't drawn symmetrically, but where they are, some of them is.
        Mat expected = twin.ofImage(image), wide, otherWide;
        dilate(expected, wide, Mat::ones(5, 5, CV_8U));
        dilate(other, otherWide, Mat::ones(5, 5, CV_8U));
        const Mat left = (expected - otherWide) + (other - wide);
        EXPECT_EQ(0, countNonZero(left.reshape(1) > 8));
    }
}

INSTANTIATE_TEST_CASE_P(RSAckermann, WarpSymmetry, testing::Range(0, int(sizeof(MODES) / sizeof(*MODES))));

}} // namespace opencv_test::
