// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "values.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>

namespace fuzz {

using namespace cv::rsackermann;

void require(bool condition, const char* message)
{
    if (condition)
        return;
    std::fprintf(stderr, "FAILED: %s\n", message);
    std::abort();
}

bool isFinite(double value)
{
    return std::isfinite(value);
}

bool isFinite(const cv::Mat& values)
{
    if (values.empty())
        return true;
    cv::Mat numbers; // cv::checkRange() refuses the largest one
    values.reshape(1).convertTo(numbers, CV_64F);
    return std::all_of(numbers.begin<double>(), numbers.end<double>(),
                       [](double value) { return std::isfinite(value); });
}

void requireQuick(double seconds, const std::function<void()>& function)
{
#if __has_feature(address_sanitizer)
    seconds = INFINITY;
#endif
    for (int calls = 0; calls < 3; calls++)
    {
        const std::clock_t start = std::clock();
        function();
        if (double(std::clock() - start) <= seconds * CLOCKS_PER_SEC)
            return;
    }
    require(false, "a call takes too long");
}

double Values::any()
{
    typedef std::numeric_limits<double> Limits;
    static const double special[] = {0,
                                     -0.,
                                     1,
                                     -1,
                                     Limits::quiet_NaN(),
                                     Limits::infinity(),
                                     -Limits::infinity(),
                                     Limits::denorm_min(),
                                     Limits::min(),
                                     Limits::max(),
                                     -Limits::max(),
                                     1e-30,
                                     1e-12,
                                     1e6,
                                     -1e6,
                                     1e30,
                                     1e154,
                                     3.5e38,
                                     32767,
                                     -32768};
    if (flag())
        return bytes_.PickValueInArray(special);
    return bytes_.ConsumeFloatingPoint<double>();
}

double Values::number(double low, double high)
{
    const int kind = integer(0, 255);
    if (kind >= 248)
        return any();
    return low + (high - low) * integer(0, 65535) / 65535.;
}

double Values::around(double usual, double low, double high)
{
    return integer(0, 3) ? usual : number(low, high);
}

RollingShutterCamera Values::camera(int largest)
{
    const cv::Size size(integer(1, largest), integer(1, largest));
    RollingShutterCamera camera = RollingShutterCamera::fromFocal(size);
    const double side = std::max(size.width, size.height);
    camera.cameraMatrix(0, 0) = number(0.3 * side, 3 * side);
    camera.cameraMatrix(1, 1) = around(camera.cameraMatrix(0, 0), 0.3 * side, 3 * side);
    camera.cameraMatrix(0, 2) = around(camera.cameraMatrix(0, 2), -side, 2 * side);
    camera.cameraMatrix(1, 2) = around(camera.cameraMatrix(1, 2), -side, 2 * side);
    camera.lensModel = integer(0, 1);
    static const int counts[] = {0, 4, 5, 8, 12, 14};
    const int count = camera.lensModel == LENS_FISHEYE ? 4 * integer(0, 1) : counts[integer(0, 5)];
    for (int i = 0; i < count; i++)
        camera.distCoeffs.push_back(number(-0.3, 0.3));
    camera.scanDirection = integer(0, 7) ? integer(SCAN_TOP_TO_BOTTOM, SCAN_BOTTOM_TO_TOP) : integer(-1, 4);
    camera.lineDelay = around(30e-6, 0, 1e-4);
    camera.referenceRow = around(camera.referenceRow, -side, 2 * side);
    camera.setRollPitch(around(0, -1, 1), around(0, -1, 1));
    camera.heading = around(0, -3.2, 3.2);
    camera.headingSigma = around(camera.headingSigma, 0, 0.5);
    camera.height = around(0, 0, 3);
    camera.rollSigma = around(camera.rollSigma, 0, 0.2);
    camera.pitchSigma = around(camera.pitchSigma, 0, 0.2);
    camera.focalSigma = around(camera.focalSigma, 0, side);
    camera.lineDelaySigma = around(0, 0, 1e-5);
    return camera;
}

AckermannMotion Values::motion(const RollingShutterCamera& camera)
{
    if (flag())
    {
        MetricMotion metric;
        metric.yawRate = number(-2, 2);
        metric.speed = number(-60, 60);
        metric.leftDistance = number(0, 20);
        metric.rightDistance = number(0, 20);
        metric.wallDirection = around(0, -3.2, 3.2);
        return AckermannMotion::fromMetric(camera, metric);
    }
    AckermannMotion motion;
    motion.status = integer(0, 7) ? int(MOTION_OK) : integer(-1, 5);
    motion.model = integer(0, 7) ? int(MODEL_4LA) : integer(-2, 5);
    motion.alpha = number(-0.1, 0.1);
    motion.wallSlope = number(-0.3, 0.3);
    motion.wallOffset = number(-0.3, 0.3);
    motion.wallRatio = number(0, 4);
    motion.roadSlope = number(-0.5, 0.5);
    motion.direction = integer(0, 7) ? 1 - 2 * integer(0, 1) : integer(-2, 2);
    motion.rollCorrection = around(0, -0.2, 0.2);
    motion.pitchCorrection = around(0, -0.2, 0.2);
    motion.headingCorrection = around(0, -0.2, 0.2);
    motion.wallDistance = around(3, 0, 20);
    if (flag())
        addOffset(motion);
    if (flag())
        addCurve(motion);
    return motion;
}

void Values::addCurve(AckermannMotion& motion)
{
    motion.rotationCurve.create(integer(1, 20), integer(0, 31) ? 3 : 2, integer(0, 31) ? CV_64F : CV_32F);
    motion.rotationCurve.setTo(number(-0.01, 0.01));
    for (int i = 0; i < 4 && motion.rotationCurve.depth() == CV_64F; i++)
        motion.rotationCurve.at<double>(integer(0, motion.rotationCurve.rows - 1), integer(0, 1)) = number(-0.1, 0.1);
}

void Values::addOffset(AckermannMotion& motion)
{
    motion.inverseDepthOffset.create(integer(3, 12), integer(3, 12), integer(0, 31) ? CV_64F : CV_32F);
    motion.inverseDepthOffset.setTo(number(-0.1, 0.1));
    for (int i = 0; i < 4 && motion.inverseDepthOffset.depth() == CV_64F; i++)
        motion.inverseDepthOffset.at<double>(integer(0, motion.inverseDepthOffset.rows - 1),
                                             integer(0, motion.inverseDepthOffset.cols - 1)) = number(-1, 1);
    motion.offsetArea = cv::Rect2d(number(-2, 1), number(-2, 1), number(-0.1, 4), number(-0.1, 4));
}

MotionPrior Values::prior()
{
    MotionPrior prior;
    prior.speed = number(-60, 60);
    prior.speedSigma = around(0, 0, 3);
    prior.yawRate = number(-2, 2);
    prior.yawRateSigma = around(0, 0, 1);
    prior.wallDirection = number(-2, 2);
    prior.wallDirectionSigma = around(0, 0, 1);
    return prior;
}

AckermannEstimator::Params Values::estimatorParams()
{
    static const int models[] = {MODEL_AUTO, MODEL_NONE, MODEL_1LA, MODEL_3LA, MODEL_4LA};
    AckermannEstimator::Params p;
    p.model = integer(0, 2) ? int(MODEL_AUTO) : models[integer(0, 4)];
    p.minLength = around(p.minLength, 0, 100);
    p.maxSlant = around(p.maxSlant, 0, 1.6);
    p.slantTolerance = around(p.slantTolerance, 0, 1);
    p.minCandidates = integer(0, 3) ? 6 : integer(0, 40);
    p.threshold = around(p.threshold, 0, 5);
    p.confidence = around(p.confidence, 0, 1);
    p.maxIterations = integer(0, 3) ? 500 : integer(0, p.maxIterations); // more are slow, not wrong
    p.seed = integer(INT_MIN, INT_MAX);
    p.maxYawRate = around(p.maxYawRate, 0, 4);
    p.maxSpeed = around(p.maxSpeed, 0, 100);
    p.wallDistance = around(p.wallDistance, 0, 10);
    p.wallDistanceLogSigma = around(p.wallDistanceLogSigma, 0, 1);
    p.roadRatio = around(p.roadRatio, 0, 5);
    p.scaleFromRoad = flag();
    p.gravitySigma = around(p.gravitySigma, 0, 0.2);
    p.priorYawRate = around(p.priorYawRate, 0, 1);
    p.vehiclePitchSigma = around(p.vehiclePitchSigma, 0, 0.2);
    p.wallDeviationSigma = around(p.wallDeviationSigma, 0, 1);
    p.reverseProbability = around(p.reverseProbability, 0, 1);
    return p;
}

} // namespace fuzz
