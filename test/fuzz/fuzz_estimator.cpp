// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "values.hpp"

// Segments, a camera, parameters and a prior for AckermannEstimator::estimate(): what comes out is finite and within
// its range.

using namespace cv::rsackermann;
using fuzz::require;

namespace {

// As many as the library promises to be quick for.
const int MANY = 1000;
const double LONGEST = 0.1; // seconds

// Upright ones of all lengths and slants, horizontal ones, and points.
cv::Matx14d makeSegment(fuzz::Values& values, const cv::Size& size)
{
    const double x = values.number(0, size.width - 1), y = values.number(0, size.height - 1);
    const double length = values.number(-size.height, size.height), slant = values.number(-0.4, 0.4);
    const bool upright = values.integer(0, 3) > 0;
    return cv::Matx14d(x, y, x + (upright ? slant * length : length), y + (upright ? length : slant * length));
}

// A few of the fuzzer's choice, which is quick; once in 256 also random upright ones.
cv::Mat makeSegments(fuzz::Values& values, const cv::Size& size)
{
    cv::Mat segments(0, 4, CV_64F);
    const bool many = values.integer(0, 255) == 1;
    const double lean = many ? values.number(0, 0.1) : 0;
    while (values.left() > 8 && segments.rows < 60)
        segments.push_back(cv::Mat(makeSegment(values, size)));
    cv::RNG rng(size.width);
    while (many && segments.rows < MANY)
    {
        const double x = rng.uniform(0., 1. * size.width), length = rng.uniform(0.1, 0.5) * size.height,
                     y = rng.uniform(0., 0.5) * size.height;
        segments.push_back(cv::Mat(cv::Matx14d(x, y, x + rng.gaussian(lean) * length, y + length)));
    }
    if (values.flag())
        segments.convertTo(segments, CV_32F);
    return segments;
}

void checkMotion(const AckermannMotion& m, const RollingShutterCamera& camera)
{
    require(m.status >= MOTION_OK && m.status <= MOTION_NOT_OBSERVABLE, "status is none of MotionStatus");
    require(m.model == MODEL_NONE || m.model == MODEL_1LA || m.model == MODEL_3LA || m.model == MODEL_4LA,
            "model is none of MotionModel");
    require(m.scale >= SCALE_UNKNOWN && m.scale <= SCALE_SPEED, "scale is none of MotionScale");
    for (const double value : {m.alpha, m.wallSlope, m.wallOffset, m.wallRatio, m.roadSlope, m.rollCorrection,
                               m.pitchCorrection, m.wallDistance, m.rms, m.expectedRaw, m.expectedResidual})
        require(fuzz::isFinite(value), "a field isn't finite");
    require(fuzz::isFinite(cv::Mat(m.covariance)), "the covariance isn't finite");
    require(m.candidates >= m.inliers && m.inliers >= 0, "there are more inliers than candidates");
    double yawRate = 0, speed = 0;
    m.yawRate(camera, yawRate);
    m.speed(camera, speed);
    require(fuzz::isFinite(yawRate) && fuzz::isFinite(speed) && fuzz::isFinite(m.delta()),
            "a metric value isn't finite");
    require(fuzz::isFinite(cv::Mat(m.metricCovariance(camera))), "the metric covariance isn't finite");
    cv::Matx33d R;
    cv::Vec3d T;
    m.pose(camera, camera.rowTime(cv::Point2d(0, 0)), R, T);
    require(fuzz::isFinite(cv::Mat(R)) && fuzz::isFinite(cv::Mat(T)), "a pose isn't finite");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    fuzz::Values values(data, size);
    try
    {
        const RollingShutterCamera camera = values.camera(values.flag() ? 2000 : 640);
        const AckermannEstimator::Params params = values.estimatorParams();
        const MotionPrior prior = values.prior();
        const cv::Mat segments = makeSegments(values, camera.imageSize);
        cv::Mat labels;
        AckermannMotion motion;
        fuzz::requireQuick(
            LONGEST, [&]() { motion = AckermannEstimator::create(camera, params)->estimate(segments, labels, prior); });
        require(labels.rows == segments.rows && labels.type() == CV_8U, "there isn't a label for each segment");
        require(cv::checkRange(labels, true, nullptr, SEGMENT_REJECTED, SEGMENT_RIGHT_WALL + 1),
                "a label is none of SegmentLabel");
        checkMotion(motion, camera);
    }
    catch (const cv::Exception& e)
    {
        require(e.code == cv::Error::StsBadArg, "an exception isn't about an argument");
        require(!e.err.empty(), "an exception has no message");
    }
    return 0;
}
