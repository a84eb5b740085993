// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_TEST_COMMON_HPP
#define OPENCV_RSACKERMANN_TEST_COMMON_HPP

#include "test_precomp.hpp"

namespace opencv_test {

const double degree = CV_PI / 180;
const double NaN = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

inline double median(std::vector<double> values)
{
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

template <class T, class Value>
void expectSameFields(const T& a, const T& b, std::initializer_list<Value T::*> fields)
{
    int number = 0;
    for (Value T::*const field : fields)
        EXPECT_EQ(a.*field, b.*field) << "field " << number++;
}

//! A camera none of whose fields has its default.
inline RollingShutterCamera exampleCamera()
{
    const std::vector<double> dist = {-0.2, 0.1, 1e-3, -2e-3, 0.01};
    RollingShutterCamera camera(Size(641, 383), Matx33d(810, 0, 318, 0, 820, 185, 0, 0, 1), dist);
    camera.scanDirection = SCAN_BOTTOM_TO_TOP;
    camera.lineDelay = 3e-5;
    camera.referenceRow = 12.5;
    camera.setRollPitch(0.1, -0.2);
    camera.rollSigma = 0.03;
    camera.pitchSigma = 0.04;
    camera.heading = 0.3;
    camera.headingSigma = 0.05;
    camera.height = 1.25;
    camera.focalSigma = 30;
    camera.distortionSigma = 0.05;
    camera.lineDelaySigma = 1e-6;
    return camera;
}

inline void expectSame(const RollingShutterCamera& a, const RollingShutterCamera& b)
{
    typedef RollingShutterCamera T;
    expectSameFields(a, b,
                     {&T::lineDelay, &T::referenceRow, &T::rollSigma, &T::pitchSigma, &T::heading, &T::headingSigma,
                      &T::height, &T::focalSigma, &T::distortionSigma, &T::lineDelaySigma});
    expectSameFields(a, b, {&T::lensModel, &T::scanDirection});
    EXPECT_EQ(a.imageSize, b.imageSize);
    EXPECT_EQ(a.cameraMatrix, b.cameraMatrix);
    EXPECT_EQ(a.distCoeffs, b.distCoeffs);
    EXPECT_EQ(a.uprightRotation, b.uprightRotation);
}

//! A motion, and a prior below, none of whose fields has its default.
inline AckermannMotion exampleMotion()
{
    AckermannMotion m;
    m.status = MOTION_OK;
    m.model = MODEL_4LA;
    m.alpha = 0.01;
    m.wallSlope = 0.3;
    m.wallOffset = -0.06;
    m.wallRatio = 1.2;
    m.roadSlope = 0.6;
    m.direction = -1;
    m.pitchRate = -0.006;
    m.rollRate = 0.007;
    m.pitchRateSigma = 0.0015;
    m.rollRateSigma = 0.0016;
    m.rollCorrection = 0.001;
    m.pitchCorrection = -0.002;
    m.headingCorrection = 0.003;
    m.wallDistance = 2.5;
    m.candidates = 61;
    m.inliers = 47;
    m.rms = 0.25;
    m.scale = SCALE_SPEED;
    m.speedSigma = 0.375;
    m.rollYawAmbiguous = true;
    m.contradictsPrior = true;
    m.seenYawRate = -0.125;
    m.seenYawRateSigma = 0.0625;
    m.seenSpeed = 17.5;
    m.seenSpeedSigma = 0.75;
    m.readoutRatio = -0.875;
    m.readoutRatioSigma = 0.125;
    m.seenHeading = -0.25;
    m.seenHeadingSigma = 0.03125;
    m.expectedRaw = 3.5;
    m.expectedResidual = 1.25;
    m.probabilityWorse = 0.0625;
    for (int i = 0; i < 16; i++)
        m.covariance.val[i] = 0.01 * (i + 1);
    m.inverseDepthOffset.create(4, 5, CV_64F);
    for (int i = 0; i < 20; i++)
        m.inverseDepthOffset.at<double>(i / 5, i % 5) = 0.001 * (i - 7);
    m.offsetArea = Rect2d(-0.5, -0.25, 1.125, 0.75);
    m.rotationCurve = (Mat_<double>(4, 3) << 0.001, -0.002, 0.0005, 0, 0, 0, 0.002, 0, -0.001, -0.003, 0.001, 0.002);
    return m;
}

inline void expectSame(const AckermannMotion& a, const AckermannMotion& b)
{
    typedef AckermannMotion T;
    expectSameFields(a, b,
                     {&T::alpha,
                      &T::wallSlope,
                      &T::wallOffset,
                      &T::wallRatio,
                      &T::roadSlope,
                      &T::pitchRate,
                      &T::rollRate,
                      &T::pitchRateSigma,
                      &T::rollRateSigma,
                      &T::rollCorrection,
                      &T::pitchCorrection,
                      &T::wallDistance,
                      &T::rms,
                      &T::expectedRaw,
                      &T::expectedResidual,
                      &T::probabilityWorse,
                      &T::seenYawRate,
                      &T::seenYawRateSigma,
                      &T::seenSpeed,
                      &T::seenSpeedSigma,
                      &T::speedSigma,
                      &T::readoutRatio,
                      &T::readoutRatioSigma,
                      &T::seenHeading,
                      &T::seenHeadingSigma,
                      &T::headingCorrection});
    EXPECT_EQ(a.contradictsPrior, b.contradictsPrior);
    expectSameFields(a, b, {&T::status, &T::model, &T::direction, &T::candidates, &T::inliers, &T::scale});
    EXPECT_EQ(a.rollYawAmbiguous, b.rollYawAmbiguous);
    EXPECT_EQ(a.covariance, b.covariance);
    for (Mat T::*const field : {&T::inverseDepthOffset, &T::rotationCurve})
    {
        const Mat &x = a.*field, &y = b.*field;
        ASSERT_EQ(x.size(), y.size());
        EXPECT_TRUE(x.empty() || x.type() == y.type());
        EXPECT_TRUE(x.empty() || x.type() != y.type() || cvtest::norm(x, y, NORM_INF) == 0);
    }
    EXPECT_EQ(a.offsetArea, b.offsetArea);
}

inline MotionPrior examplePrior()
{
    MotionPrior p;
    p.speed = 11.5;
    p.speedSigma = 0.4;
    p.yawRate = -0.3;
    p.yawRateSigma = 0.02;
    p.wallDirection = 0.11;
    p.wallDirectionSigma = 0.03;
    return p;
}

inline void expectSame(const MotionPrior& a, const MotionPrior& b)
{
    typedef MotionPrior T;
    expectSameFields(
        a, b, {&T::speed, &T::speedSigma, &T::yawRate, &T::yawRateSigma, &T::wallDirection, &T::wallDirectionSigma});
}

//! Parameters none of which has its default; the same holds for the other ones below.
inline AckermannEstimator::Params exampleEstimatorParams()
{
    AckermannEstimator::Params p;
    p.model = MODEL_3LA;
    p.detector = DETECTOR_FLD;
    p.minLength = 21;
    p.maxSlant = 0.4;
    p.slantTolerance = 0.07;
    p.minCandidates = 9;
    p.threshold = 0.7;
    p.confidence = 0.95;
    p.maxIterations = 77;
    p.seed = 5;
    p.maxYawRate = 1.25;
    p.maxSpeed = 33;
    p.wallDistance = 4.5;
    p.wallDistanceLogSigma = 0.15;
    p.roadRatio = 1.5;
    p.scaleFromRoad = true;
    p.gravitySigma = 0.01;
    p.vehiclePitchSigma = 0.02;
    p.wallDeviationSigma = 0.3;
    p.priorYawRate = 0.3;
    p.priorSpeed = 9;
    p.priorSpeedLogSigma = 0.7;
    p.priorWallDistance = 11;
    p.priorWallDistanceLogSigma = 0.75;
    p.priorSpeedWallCorrelation = 0.5;
    p.priorHeight = 2.5;
    p.priorHeightLogSigma = 0.45;
    p.priorWallRatioLogSigma = 0.55;
    p.priorReadoutTime = 0.02;
    p.priorReadoutTimeLogSigma = 0.65;
    p.standingProbability = 0.25;
    p.reverseProbability = 0.125;
    p.harmAversion = 2;
    return p;
}

inline void expectSame(const AckermannEstimator::Params& a, const AckermannEstimator::Params& b)
{
    typedef AckermannEstimator::Params T;
    expectSameFields(a, b,
                     {&T::minLength,
                      &T::maxSlant,
                      &T::slantTolerance,
                      &T::threshold,
                      &T::confidence,
                      &T::maxYawRate,
                      &T::maxSpeed,
                      &T::wallDistance,
                      &T::wallDistanceLogSigma,
                      &T::roadRatio,
                      &T::gravitySigma,
                      &T::vehiclePitchSigma,
                      &T::wallDeviationSigma,
                      &T::priorYawRate,
                      &T::priorSpeed,
                      &T::priorSpeedLogSigma,
                      &T::priorWallDistance,
                      &T::priorWallDistanceLogSigma,
                      &T::priorSpeedWallCorrelation,
                      &T::priorHeight,
                      &T::priorHeightLogSigma,
                      &T::priorWallRatioLogSigma,
                      &T::priorReadoutTime,
                      &T::priorReadoutTimeLogSigma,
                      &T::standingProbability,
                      &T::reverseProbability,
                      &T::harmAversion});
    expectSameFields(a, b, {&T::model, &T::detector, &T::minCandidates, &T::maxIterations, &T::seed});
    EXPECT_EQ(a.scaleFromRoad, b.scaleFromRoad);
}

inline WarpMapGenerator::Params exampleWarpParams()
{
    WarpMapGenerator::Params p;
    p.newCameraMatrix = Matx33d(500, 0, 300, 0, 510, 200, 0, 0, 1);
    p.newSize = Size(601, 401);
    p.maxIterations = 17;
    p.tolerance = 1e-5;
    return p;
}

inline void expectSame(const WarpMapGenerator::Params& a, const WarpMapGenerator::Params& b)
{
    EXPECT_EQ(a.newCameraMatrix, b.newCameraMatrix);
    EXPECT_EQ(a.newSize, b.newSize);
    EXPECT_EQ(a.maxIterations, b.maxIterations);
    EXPECT_EQ(a.tolerance, b.tolerance);
}

} // namespace opencv_test

#endif // OPENCV_RSACKERMANN_TEST_COMMON_HPP
