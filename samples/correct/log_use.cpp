// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "log_use.hpp"
#include "files.hpp"
#include "options.hpp"
#include "estimator_options.hpp"
#include "units.hpp"

#include <cmath>
#include <iostream>
#include <map>

namespace rsackermann_samples {

// Seconds between samples of a log: a car that brakes by 1 m/s2 meanwhile is 2 km/h (SPEED_SIGMA) off the line that
// connects them.
static const double RAREST_SAMPLES = 2;

cv::rsackermann::MotionPrior priorOf(const FrameFacts& facts, const cv::rsackermann::MotionPrior& other)
{
    cv::rsackermann::MotionPrior prior = other;
    if (!std::isnan(facts.speed))
    {
        prior.speed = facts.speed * KMH;
        prior.speedSigma = (std::isnan(facts.speedSigma) ? SPEED_SIGMA : facts.speedSigma) * KMH;
    }
    if (!std::isnan(facts.yawRate))
    {
        prior.yawRate = facts.yawRate * DEGREE;
        prior.yawRateSigma = (std::isnan(facts.yawRateSigma) ? YAW_RATE_SIGMA : facts.yawRateSigma) * DEGREE;
    }
    return prior;
}

void checkLog(const DriveLog& log, const InputList& inputs, const std::string& program)
{
    size_t images = 0, unknown = 0, videos = 0;
    std::map<std::string, std::string> inputsOfNames;
    for (const Input& input : inputs.inputs)
    {
        const std::string name = log.nameOf(input.name);
        const std::string other = inputsOfNames.insert(std::make_pair(name, input.name)).first->second;
        if (!name.empty() && other != input.name)
            throw UsageError("the log's " + name + " is both " + other + " and " + input.name +
                             "; name them with their folders");
        videos += isVideo(input.name);
        if (input.isFile() && !isVideo(input.name))
        {
            images++;
            unknown += !log.names(input.name, input.number);
        }
    }
    if (videos > 1 && log.hasNumberAlone())
        throw UsageError("the log's column frame needs the column file: there are several videos");
    log.checkNames(inputs);
    if (images > 0 && unknown == images)
        throw UsageError("the log names none of the images (columns file or frame), and samples need their times");
    if (log.shortestStep() > RAREST_SAMPLES)
        std::cerr << program << ": no sample of the log is less than " << log.shortestStep()
                  << " s after the one before: its times seem not to be in seconds" << std::endl;
    if (unknown > 0)
        std::cerr << program << ": the log doesn't name " << unknown << " of the " << images << " images" << std::endl;
}

void checkGyro(const GyroRecording& gyro, const DriveLog& log, const InputList& inputs)
{
    int videos = 0;
    for (const Input& input : inputs.inputs)
        videos += isVideo(input.name) && std::isnan(log.of(input.name, 0, NAN).time);
    if (!gyro.times.empty() && videos > 1)
        throw UsageError(cv::format("--gyro is of one video, but each of %d begins at its 0 s: give them one by one, "
                                    "each with its gyro, or the times of their frames (--log)",
                                    videos));
}

} // namespace rsackermann_samples
