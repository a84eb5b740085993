// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "estimator_options.hpp"
#include "units.hpp"

#include "opencv2/rsackermann/motion.hpp"

namespace rsackermann_samples {

using namespace cv::rsackermann;

const std::vector<std::string> DETECTOR_WORDS = {"lsd", "fld", "edlines", "verticals"};

const char* const DETECTOR_KEY = "{detector   | verticals | line segment detector: verticals, lsd, fld or edlines}";

int readDetector(const Options& options)
{
    return options.choice("detector", DETECTOR_WORDS);
}

int readModel(const Options& options)
{
    const int models[] = {MODEL_AUTO, MODEL_4LA, MODEL_3LA, MODEL_1LA, MODEL_NONE};
    return models[options.choice("model", {"auto", "4la", "3la", "1la", "none"})];
}

const char* const PRIOR_KEYS =
    "{speed      |        | km/h that the car reports, negative in reverse; needs the line delay; with --height it "
    "gives the road}"
    "{speed_sigma |       | standard deviation of --speed in km/h (default 2)}"
    "{yaw_rate   |        | deg/s that the car or a gyro reports, positive to the right; needs the line delay}"
    "{yaw_rate_sigma |    | standard deviation of --yaw_rate in deg/s (default 1)}";

namespace {

// A value with its standard deviation, in the given unit, if it is given.
void readMeasurement(const Options& options, const std::string& name, double defaultSigma, double unit, double& value,
                     double& sigma)
{
    const double limit = 1000;
    const std::string sigmaName = name + "_sigma";
    if (options.given(name))
    {
        value = options.number(name, -limit, limit) * unit;
        sigma = (options.given(sigmaName) ? options.positive(sigmaName, limit) : defaultSigma) * unit;
    }
    else if (options.given(sigmaName))
        throw UsageError("--" + sigmaName + " needs --" + name);
}

} // namespace

MotionPrior readPriorOptions(const Options& options)
{
    MotionPrior prior;
    readMeasurement(options, "speed", SPEED_SIGMA, KMH, prior.speed, prior.speedSigma);
    readMeasurement(options, "yaw_rate", YAW_RATE_SIGMA, DEGREE, prior.yawRate, prior.yawRateSigma);
    return prior;
}

} // namespace rsackermann_samples
