// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "frame_corrector.hpp"
#include "caption.hpp"
#include "log_use.hpp"
#include "map_distance.hpp"
#include "picture.hpp"
#include "units.hpp"

#include <cmath>

namespace rsackermann_samples {

using namespace cv::rsackermann;

namespace {

double orElse(double value, double other)
{
    return std::isnan(value) ? other : value;
}

// Without the line delay, of whose lack a warning tells, images are no sequence.
RollingShutterCorrector::Params paramsFor(const RollingShutterCamera& camera, RollingShutterCorrector::Params params)
{
    params.warp = StripWarp::coarse(camera);
    params.sequence = params.sequence && camera.lineDelay > 0;
    return params;
}

} // namespace

void FrameCorrector::prepare(const cv::Size& size)
{
    if (corrector_ && camera_.imageSize == size)
        return;
    camera_ = job_.camera.makeCamera(size);
    const RollingShutterCorrector::Params params = paramsFor(camera_, job_.params);
    corrector_ = RollingShutterCorrector::create(camera_, params);
    setGyroDelay(gyroDelay_);
    warp_.reset(new StripWarp(camera_));
    WarpMapGenerator::create(camera_, params.warp)->initRectifyMap(AckermannMotion(), lensMap1_, lensMap2_);
}

void FrameCorrector::beginFrame(const FrameFacts& facts)
{
    facts_ = facts;
    time_ = timeAfter(facts);
}

double FrameCorrector::timeAfter(const FrameFacts& facts) const
{
    return orElse(facts.time, time_ + facts.intervals * job_.params.frameInterval);
}

void FrameCorrector::useFacts()
{
    corrector_->setTimestamp(job_.params.sequence ? time_ : facts_.time);
    CameraSettings settings = job_.camera;
    settings.roll = orElse(facts_.roll, settings.roll);
    settings.pitch = orElse(facts_.pitch, settings.pitch);
    if (!std::isnan(facts_.roll)) // as the options do
    {
        settings.rollSigma = 0;
        settings.rollIsGiven = true;
    }
    if (!std::isnan(facts_.pitch))
    {
        settings.pitchSigma = 0;
        settings.pitchIsGiven = true;
    }
    roll_ = settings.roll;
    pitch_ = settings.pitch;
    camera_ = settings.makeCamera(camera_.imageSize);
    RollingShutterCorrector::Params params = paramsFor(camera_, job_.params);
    setGravitySigma(orElse(facts_.gravitySigma, job_.gravitySigma), camera_, params.estimator);
    corrector_->setCamera(camera_);
    warp_->setCamera(camera_);
    corrector_->setParams(params);

    corrector_->setPrior(priorOf(facts_, job_.prior));
}

void FrameCorrector::reset()
{
    isFirst_ = true;
    time_ = -job_.params.frameInterval; // without times the first one is at 0, as in a video
    if (corrector_)
        corrector_->reset();
}

void FrameCorrector::setGyroDelay(double delay)
{
    gyroDelay_ = delay;
    if (!corrector_ || job_.gyro.times.empty())
        return;
    corrector_->clearGyro();
    corrector_->addGyro(cv::Mat(job_.gyro.times - delay), job_.gyro.rates);
}

double FrameCorrector::gyroDelay() const
{
    double delay;
    cv::Vec3d axes, bias;
    return corrector_ && corrector_->getGyroAlignment(delay, axes, bias) ? delay : 0;
}

bool FrameCorrector::contradictsGyro() const
{
    double delay;
    cv::Vec3d axes, bias;
    return !corrector_->getGyroAlignment(delay, axes, bias);
}

void FrameCorrector::warp(const cv::Mat& image, const DepthMap& depth, CorrectedFrame& frame)
{
    const AckermannMotion& motion = frame.report.motion;
    cv::Vec2d seconds;
    if (!job_.output.empty() && motion.status != MOTION_OK && warp_->hasNoLens())
        frame.image = image;
    else if (!job_.output.empty())
        warp_->correct(image, motion, depth, frame.image, seconds);
    if (!job_.maps.empty())
        warp_->maps(motion, depth, frame.map1, frame.map2);
    frame.report.timings += cv::Vec4d(0, 0, 1000 * seconds[0], 1000 * seconds[1]);
}

CorrectedFrame FrameCorrector::uncorrected(const cv::Mat& image, const std::string& error)
{
    prepare(image.size());
    CorrectedFrame frame;
    frame.report.camera = camera_;
    frame.report.time = facts_.time;
    frame.report.isLogged = facts_.isLogged;
    frame.report.error = error;
    warp(image, DepthMap(), frame);
    if (!job_.overlay.empty())
    {
        frame.overlay = pictureOf(image);
        drawCaption(frame.overlay, "failed: see the report");
    }
    return frame;
}

CorrectedFrame FrameCorrector::correct(const cv::Mat& image, const NextFrame& next, const std::string& depthFile)
{
    prepare(image.size());
    DepthMap depth;
    if (!depthFile.empty())
        depth = readDepth(depthFile, job_.depth.meaning(), camera_);
    CorrectedFrame frame;
    FrameReport& report = frame.report;
    useFacts();
    if (wantsNext() && next.image.size() == image.size())
        corrector_->setNextFrame(next.image, next.time);
    if (job_.params.sequence)
        report.change = change_.to(image);
    isFirst_ = false;
    report.camera = camera_;
    report.roll = roll_;
    report.pitch = pitch_;
    cv::Mat coarse, mask, map1, map2, segments, labels;
    const DepthMap coarseDepth = StripWarp::coarse(depth);
    report.motion = job_.linesGiven ? corrector_->correctWithSegments(image, job_.lines, coarse, mask, coarseDepth)
                                    : corrector_->correct(image, coarse, mask, coarseDepth);
    corrector_->getSegments(segments, labels);
    corrector_->getMaps(map1, map2);
    report.time = facts_.time;
    report.isLogged = facts_.isLogged;
    report.prior = corrector_->getPrior();
    report.segments = segments.rows;
    // Without a motion the maps undo the lens only.
    report.meanShift = report.motion.status == MOTION_OK ? meanDistance(map1, map2, lensMap1_, lensMap2_, mask) : 0;
    report.timings = corrector_->getTimings();
    report.isGyroWrong = contradictsGyro();
    report.isGyroUsed = corrector_->isGyroUsed();
    report.isDepthGiven = !depth.empty();
    report.isDepthUsed = corrector_->isDepthUsed();
    const DepthMap used = corrector_->getUsedDepth(); // its values may be coarse ones
    depth.scale = used.scale;
    depth.shift = used.shift;
    warp(image, report.isDepthUsed ? depth : DepthMap(), frame);
    if (!job_.overlay.empty())
    {
        frame.overlay = pictureOf(image);
        drawMotion(frame.overlay, segments, labels, camera_, report.motion);
        drawCaption(frame.overlay, captionOf(report.motion));
    }
    return frame;
}

} // namespace rsackermann_samples
