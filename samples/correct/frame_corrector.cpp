// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "frame_corrector.hpp"
#include "map_distance.hpp"
#include "units.hpp"

#include "opencv2/imgproc.hpp"
#include <cmath>

namespace rsackermann_samples {

using namespace cv::rsackermann;

namespace {

double orElse(double value, double other)
{
    return std::isnan(value) ? other : value;
}

// The 8-bit colour picture of an image, to draw upon.
cv::Mat pictureOf(const cv::Mat& image)
{
    cv::Mat picture;
    if (image.depth() == CV_16U)
        image.convertTo(picture, CV_8U, 1 / 257.);
    else
        picture = image.clone();
    if (picture.channels() == 1)
        cv::cvtColor(picture, picture, cv::COLOR_GRAY2BGR);
    else if (picture.channels() == 4)
        cv::cvtColor(picture, picture, cv::COLOR_BGRA2BGR);
    return picture;
}

} // namespace

void FrameCorrector::prepare(const cv::Size& size)
{
    if (corrector_ && camera_.imageSize == size)
        return;
    camera_ = job_.camera.makeCamera(size);
    corrector_ = RollingShutterCorrector::create(camera_, job_.params);
    WarpMapGenerator::create(camera_, job_.params.warp)->initRectifyMap(AckermannMotion(), lensMap1_, lensMap2_);
}

void FrameCorrector::tell(const FrameFacts& facts)
{
    corrector_->setTimestamp(facts.time);
    CameraSettings settings = job_.camera;
    settings.roll = orElse(facts.roll, settings.roll);
    settings.pitch = orElse(facts.pitch, settings.pitch);
    camera_ = settings.makeCamera(camera_.imageSize);
    corrector_->setCamera(camera_);

    RollingShutterCorrector::Params params = job_.params;
    if (!std::isnan(facts.gravitySigma))
        setGravitySigma(facts.gravitySigma, params.estimator);
    corrector_->setParams(params);

    MotionPrior prior = job_.prior;
    if (!std::isnan(facts.speed))
    {
        prior.speed = facts.speed * KMH;
        prior.speedSigma = orElse(facts.speedSigma, SPEED_SIGMA) * KMH;
    }
    if (!std::isnan(facts.yawRate))
    {
        prior.yawRate = facts.yawRate * DEGREE;
        prior.yawRateSigma = orElse(facts.yawRateSigma, YAW_RATE_SIGMA) * DEGREE;
    }
    corrector_->setPrior(prior);
}

void FrameCorrector::reset()
{
    if (corrector_)
        corrector_->reset();
}

CorrectedFrame FrameCorrector::correct(const cv::Mat& image, const FrameFacts& facts)
{
    prepare(image.size());
    CorrectedFrame frame;
    FrameReport& report = frame.report;
    cv::Mat mask, segments, labels;
    tell(facts);
    report.camera = camera_;
    report.motion = job_.linesGiven ? corrector_->correctWithSegments(image, job_.lines, frame.image, mask)
                                    : corrector_->correct(image, frame.image, mask);
    corrector_->getSegments(segments, labels);
    corrector_->getMaps(frame.map1, frame.map2);
    report.segments = segments.rows;
    // Without a motion the maps undo the lens only.
    report.meanShift = report.motion.status == MOTION_OK ? meanDistance(frame.map1, frame.map2, lensMap1_, lensMap2_, mask) : 0;
    report.timings = corrector_->getTimings();
    if (!job_.overlay.empty())
    {
        frame.overlay = pictureOf(image);
        drawMotion(frame.overlay, segments, labels, camera_, report.motion);
    }
    return frame;
}

} // namespace rsackermann_samples
