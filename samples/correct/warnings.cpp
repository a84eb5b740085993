// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "warnings.hpp"
#include "repeated_images.hpp"
#include "units.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>

namespace rsackermann_samples {

void Warnings::add(const std::string& input, const std::vector<FrameReport>& frames)
{
    addContradiction(input, frames);
    addTimes(input, frames);
    for (const FrameReport& frame : frames)
    {
        hasFrame_ = true;
        changes_.push_back(frame.change);
        isLogUsed_ |= frame.isLogged;
        addReference(frame);
        addGyro(frame);
        addDepth(frame);
        addPixels(frame);
        addSpeed(frame);
        if (job_.params.sequence && frame.motion.status == cv::rsackermann::MOTION_OK)
        {
            lastTilts_ = cv::Vec2d(frame.motion.rollCorrection, frame.motion.pitchCorrection);
            tilts_ += lastTilts_;
            tiltedCamera_ = frame.camera;
            tilted_++;
            givenTilts_ = cv::Vec2d(frame.roll, frame.pitch);
        }
        if (frame.motion.readoutRatioSigma > 0)
            lastMotion_ = frame.motion;
        if (frame.motion.seenHeadingSigma > 0)
        {
            seenHeading_ = frame.motion.seenHeading;
            seenHeadingSigma_ = frame.motion.seenHeadingSigma;
            givenHeading_ = frame.camera.heading;
            givenHeadingSigma_ = frame.camera.headingSigma;
        }
    }
}

void Warnings::end()
{
    // The frames of a log may all be in other shards.
    if (hasFrame_ && !job_.log.empty() && !isLogUsed_ && job_.shardCount == 1)
        warn(job_.log.whyUseless());
    endSequence("");
    addRounding();
    addRepeated();
    addReadout();
    addHeading();
    addTilts();
}

// Intervals that differ by one unit of the times' last decimal are those of a steady clock, rounded.
void Warnings::addRounding()
{
    std::vector<double> intervals;
    for (size_t i = 1; i < times_.size(); i++)
        if (times_[i] > times_[i - 1])
            intervals.push_back(times_[i] - times_[i - 1]);
    if (intervals.empty())
        return;
    const double shortest = *std::min_element(intervals.begin(), intervals.end());
    for (double unit : {0.1, 0.01})
    {
        const double longer = shortest + unit, tolerance = 1e-4 * unit; // numbers of 1e9 s are exact to less
        const auto isRounded = [=](double time) { return std::abs(std::remainder(time, unit)) < tolerance; };
        const auto countOf = [&](double interval) {
            return std::count_if(intervals.begin(), intervals.end(),
                                 [=](double other) { return std::abs(other - interval) < tolerance; });
        };
        // One in ten rounds by what is seen: the difference of two rounded times errs by unit / sqrt(6). An interval of
        // twice the other is that of a frame that is missing.
        const size_t least = intervals.size() / 10 + 1;
        if (!std::all_of(times_.begin(), times_.end(), isRounded) || longer > 1.9 * shortest ||
            unit / std::sqrt(6.) < 0.05 * shortest || size_t(countOf(shortest)) < least ||
            size_t(countOf(longer)) < least)
            continue;
        warn(cv::format(
            "times seem to be rounded to %g s: intervals of %g and %g s alternate, by which speeds and yaw rates err; give "
            "times with more decimals, or none if frames follow each other at 30 frames/s",
            unit, shortest, longer));
        return;
    }
}

void Warnings::addRepeated()
{
    const std::string words = repeatedImages(changes_);
    if (!words.empty())
        warn(words);
}

void Warnings::addReadout()
{
    const double ratio = lastMotion_.readoutRatio, sigma = lastMotion_.readoutRatioSigma, sigmas = 3;
    if (std::abs(ratio - 1) > sigmas * sigma)
        warn(cv::format(
            "verticals lean as if the read-out took %.2f times (sigma %.2f) as long as given, negative if rows "
            "are read in the other direction: check --scan and --readout",
            ratio, sigma));
}

void Warnings::addHeading()
{
    const double drift = 0.2 * DEGREE, sigmas = 3; // drift: on a road with a crown
    if (std::abs(seenHeading_ - givenHeading_) >
        sigmas * std::hypot(drift, std::hypot(givenHeadingSigma_, seenHeadingSigma_)))
        warn(cv::format("frames move as if the heading was %.1f degrees (sigma %.1f), which is %.1f: check --heading, "
                        "by which yaw rates err",
                        seenHeading_ / DEGREE, seenHeadingSigma_ / DEGREE, givenHeading_ / DEGREE));
}

// If a drive as a whole differs by more than one of its frames may. The last one knows best by what.
void Warnings::addTilts()
{
    if (tilted_ == 0)
        return;
    const cv::rsackermann::AckermannEstimator::Params& params = job_.params.estimator;
    const cv::rsackermann::RollingShutterCamera& camera = tiltedCamera_;
    const double c = std::cos(camera.heading), s = std::sin(camera.heading), roll = params.gravitySigma,
                 pitch = params.vehiclePitchSigma, sigmas = 3,
                 sigma[] = {std::hypot(camera.rollSigma, std::hypot(c * roll, s * pitch)),
                            std::hypot(camera.pitchSigma, std::hypot(s * roll, c * pitch))};
    const char* const names[] = {"roll", "pitch"};
    for (int i = 0; i < 2; i++)
    {
        if (std::abs(tilts_[i] / tilted_) > sigmas * sigma[i])
            warn(cv::format("frames look as if the %s was %.1f degrees, which is %.1f: check --%s", names[i],
                            givenTilts_[i] + lastTilts_[i] / DEGREE, givenTilts_[i], names[i]));
    }
}

// Once for each input or sequence: a sensor that is wrong is so in many frames.
void Warnings::addContradiction(const std::string& input, const std::vector<FrameReport>& frames)
{
    const auto contradicts = [](const FrameReport& frame) { return frame.motion.contradictsPrior; };
    const auto first = std::find_if(frames.begin(), frames.end(), contradicts);
    if (first == frames.end() || (job_.params.sequence && first->frame < 0 && hasContradiction_))
        return;
    hasContradiction_ = true;
    const int others = int(std::count_if(first + 1, frames.end(), contradicts));
    const std::string more = others > 0 ? cv::format(" and %d more", others) : "",
                      which = first->frame >= 0 ? cv::format("frame %d", first->frame) + more + ": " : "";
    warn(input + ": " + which + contradiction(*first, job_.params.estimator.wallDistance));
}

// Metres that are wrong make all speeds wrong; those of a single image end near the limit, whatever it shows.
void Warnings::addSpeed(const FrameReport& frame)
{
    const cv::rsackermann::AckermannMotion& m = frame.motion;
    const double limit = job_.params.estimator.maxSpeed;
    double speed;
    if ((m.scale == cv::rsackermann::SCALE_WALL || m.scale == cv::rsackermann::SCALE_ROAD) &&
        m.speed(frame.camera, speed) && std::abs(speed) > 0.99 * limit)
        warnOnce(cv::format("an image shows a speed of %.0f km/h or more: the distance of --%s is too large, or the "
                            "read-out too short",
                            limit / KMH, m.scale == cv::rsackermann::SCALE_WALL ? "wall" : "height"));
}

// Once: times in another unit, or those of another column, leave nothing of a sequence.
void Warnings::addTimes(const std::string& input, const std::vector<FrameReport>& frames)
{
    const bool isVideo = !frames.empty() && frames[0].frame >= 0;
    if (isVideo)
    {
        endSequence("");
        lastTime_ = std::numeric_limits<double>::quiet_NaN();
    }
    for (const FrameReport& frame : frames)
    {
        if (job_.params.sequence && !isVideo && std::isfinite(frame.time))
            times_.push_back(frame.time);
        if (job_.params.sequence && !isVideo && std::isnan(frame.time) && frame.error.empty() && untimed_++ > 0)
            warnOnce(NO_TIMES);
        const double gap = frame.time - lastTime_;
        lastTime_ = frame.time;
        if (job_.params.sequence)
            addInterval(frame, std::isnan(frame.time) && untimed_ > 1 ? job_.params.frameInterval : gap);
        if (!job_.params.sequence || hasGap_ || !(gap <= 0 || gap >= cv::rsackermann::LONGEST_INTERVAL))
            continue;
        hasGap_ = true;
        warn(cv::format(
            "%s: its time is %g s after that of the image before: images that are %g s or more later, or not "
            "later, begin another sequence",
            input.c_str(), gap, cv::rsackermann::LONGEST_INTERVAL));
    }
    if (isVideo)
    {
        endSequence(input + ": ");
        lastTime_ = std::numeric_limits<double>::quiet_NaN();
    }
}

// Since the frame before, if there is one.
void Warnings::addInterval(const FrameReport& frame, double interval)
{
    if (interval <= 0 || interval >= cv::rsackermann::LONGEST_INTERVAL)
        endSequence("");
    else if (interval > 0)
        intervals_.push_back(interval);
    camera_ = frame.camera;
}

// Times may jitter, and frames be missing: the median is that of a steady clock.
void Warnings::endSequence(const std::string& source)
{
    if (intervals_.empty())
        return;
    const auto median = intervals_.begin() + std::ptrdiff_t(intervals_.size() / 2);
    std::nth_element(intervals_.begin(), median, intervals_.end());
    const std::string doubt = doubtOfReadOut(camera_, *median);
    if (!doubt.empty())
        warnOnce(source + doubt);
    intervals_.clear();
}

void Warnings::addReference(const FrameReport& frame)
{
    const cv::rsackermann::RollingShutterCamera& camera = frame.camera;
    const int last = (camera.isRowShutter() ? camera.imageSize.height : camera.imageSize.width) - 1;
    if (camera.referenceRow < 0 || camera.referenceRow > last)
        warnOnce(
            cv::format("the reference line, %g, is none of the image's (0 to %d), which may show little of what is "
                       "seen at its instant",
                       camera.referenceRow, last));
}

// How fast frames turn that do without the gyro, by their points and by it: since the frame before, as what shakes to
// and fro between frames is on neither.
void Warnings::compareGyro(const FrameReport& frame)
{
    const cv::rsackermann::AckermannMotion& motion = frame.motion;
    const cv::Mat& times = job_.gyro.times;
    const auto samplesBefore = [&times](double time) {
        const double *const first = times.ptr<double>(0), *const end = first + times.rows;
        return int(std::lower_bound(first, end, time) - first);
    };
    const double interval = frame.time - gyroTime_;
    const int from = samplesBefore(gyroTime_), to = samplesBefore(frame.time);
    gyroTime_ = frame.time;
    double yawRate;
    if (motion.status != cv::rsackermann::MOTION_OK || frame.isGyroUsed ||
        !(interval > 0 && interval < cv::rsackermann::LONGEST_INTERVAL) || !(0 < from && from < to) ||
        to == times.rows || !motion.yawRate(frame.camera, yawRate))
        return;
    const double unit = frame.camera.secondsPerUnitTime();
    squaresOfPoints_ +=
        std::pow(yawRate, 2) + std::pow(motion.pitchRate / unit, 2) + std::pow(motion.rollRate / unit, 2);
    cv::Mat mean;
    cv::reduce(job_.gyro.rates.rowRange(from, to), mean, 0, cv::REDUCE_AVG);
    squaresOfGyro_ += cv::norm(mean, cv::NORM_L2SQR);
}

// The likely reason if it contradicts the images.
std::string Warnings::doubtOfGyro() const
{
    const double power = std::log(squaresOfGyro_ / squaresOfPoints_) / 2 / std::log(1 / DEGREE);
    if (std::abs(power) > 0.5 && std::abs(power) < 1.5)
        return power > 0 ? "its rates seem to be degrees that are read as radians"
                         : "its rates seem to be radians that are read as degrees";
    return "its axes or clock may be others, or --scan, or the camera shakes more than frames show";
}

void Warnings::addGyro(const FrameReport& frame)
{
    const cv::Mat& times = job_.gyro.times;
    // Of images whose rows have no times the command line alone says it.
    if (times.empty() || !frame.camera.isRowShutter() || !(frame.camera.secondsPerUnitTime() > 0))
        return;
    compareGyro(frame);
    if (!job_.params.sequence && std::isnan(frame.time))
        warnOnce("--gyro has no effect on images without a time: give --log with the column time_s");
    else if (frame.isGyroWrong)
        warnOnce("the images contradict the gyro, which isn't used where they do: " + doubtOfGyro());
    else if (!frame.isGyroUsed &&
             (frame.time < *times.ptr<double>(0) || frame.time > *times.ptr<double>(times.rows - 1)))
        warnOnce(
            cv::format("--gyro has no effect on images outside of its times, %.12g to %.12g s: give --gyro_delay if "
                       "its clock is another",
                       *times.ptr<double>(0), *times.ptr<double>(times.rows - 1)));
    else if (!frame.isGyroUsed && frame.motion.status == cv::rsackermann::MOTION_OK)
        warnOnce(std::string("--gyro isn't used on images in its gaps") +
                 (job_.params.sequence ? ", and where points contradict it" : ""));
}

void Warnings::addDepth(const FrameReport& frame)
{
    if (!frame.isDepthGiven || frame.isDepthUsed || frame.motion.status != cv::rsackermann::MOTION_OK)
        return;
    warnOnce(
        job_.depth.meaning().kind == DepthMeaning::RELATIVE
            ? "images that contradict --depth, or don't show that it is theirs, are corrected without it: "
              "depth_used in the report"
            : "--depth has no effect where no depth is known, where it contradicts verticals or tracked points or is in another unit "
              "than walls and road (give --depth_scale), and on images whose speed in metres is unknown (give --speed, --wall or "
              "--scale_from_road)");
}

// OpenCV can't write what a video says of the shape of its pixels.
void Warnings::addPixels(const FrameReport& frame)
{
    if (frame.pixelAspect != 1 && !(job_.output.empty() && job_.overlay.empty()))
        warnOnce(cv::format("the pixels of the video are %.4g times as wide as high, which results don't say: encode "
                            "them with ffmpeg -vf setsar=%.4g",
                            frame.pixelAspect, frame.pixelAspect));
}

void Warnings::warn(const std::string& message)
{
    progress_.clear();
    std::cerr << "rsackermann_correct: " << message << std::endl;
}

void Warnings::warnOnce(const std::string& message)
{
    if (given_.insert(message).second)
        warn(message);
}

} // namespace rsackermann_samples
