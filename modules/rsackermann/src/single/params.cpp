// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../checks.hpp"
#include "../storage.hpp"
#include "../features/detectors.hpp"

namespace cv { namespace rsackermann {

static void checkProbability(double value, const char* name)
{
    REJECT_IF(!(value > 0 && value < 1), "%s is %g; a number between 0 and 1 is expected", name, value);
}

AckermannEstimator::Params::Params()
    : model(MODEL_AUTO), detector(DETECTOR_VERTICALS), minLength(35), maxSlant(0.35), slantTolerance(0.06),
      minCandidates(6), threshold(0.5), confidence(0.99), maxIterations(500), seed(0), maxYawRate(CV_PI / 2),
      maxSpeed(200 / 3.6), wallDistance(0), wallDistanceLogSigma(0.1), roadRatio(0), scaleFromRoad(false),
      gravitySigma(CV_PI / 180), vehiclePitchSigma(0.3 * CV_PI / 180), wallDeviationSigma(0.4),
      priorYawRate(5 * CV_PI / 180), priorSpeed(12), priorSpeedLogSigma(0.8), priorWallDistance(15),
      priorWallDistanceLogSigma(0.9), priorWallRatioLogSigma(0.8), priorSpeedWallCorrelation(0.6), priorHeight(1.3),
      priorHeightLogSigma(0.35), priorReadoutTime(0.05), priorReadoutTimeLogSigma(0.7), standingProbability(.5),
      reverseProbability(0.02), harmAversion(1)
{
}

void AckermannEstimator::Params::write(FileStorage& fs) const
{
    fs << "model" << model << "detector" << detector << "min_length" << minLength;
    fs << "max_slant" << maxSlant << "slant_tolerance" << slantTolerance << "min_candidates" << minCandidates;
    fs << "threshold" << threshold << "confidence" << confidence << "max_iterations" << maxIterations << "seed" << seed;
    fs << "max_yaw_rate" << maxYawRate << "max_speed" << maxSpeed << "wall_distance" << wallDistance;
    fs << "wall_distance_log_sigma" << wallDistanceLogSigma;
    fs << "road_ratio" << roadRatio << "scale_from_road" << scaleFromRoad << "gravity_sigma" << gravitySigma;
    fs << "vehicle_pitch_sigma" << vehiclePitchSigma;
    fs << "wall_deviation_sigma" << wallDeviationSigma << "prior_yaw_rate" << priorYawRate;
    fs << "prior_speed" << priorSpeed << "prior_speed_log_sigma" << priorSpeedLogSigma;
    fs << "prior_wall_distance" << priorWallDistance << "prior_wall_distance_log_sigma" << priorWallDistanceLogSigma;
    fs << "prior_wall_ratio_log_sigma" << priorWallRatioLogSigma << "prior_readout_time" << priorReadoutTime;
    fs << "prior_readout_time_log_sigma" << priorReadoutTimeLogSigma;
    fs << "prior_speed_wall_correlation" << priorSpeedWallCorrelation;
    fs << "prior_height" << priorHeight << "prior_height_log_sigma" << priorHeightLogSigma;
    fs << "standing_probability" << standingProbability << "reverse_probability" << reverseProbability;
    fs << "harm_aversion" << harmAversion;
}

void AckermannEstimator::Params::read(const FileNode& fn)
{
    readFields(fn, "model", model, "detector", detector, "min_length", minLength, "max_slant", maxSlant);
    readFields(fn, "slant_tolerance", slantTolerance, "min_candidates", minCandidates, "threshold", threshold);
    readFields(fn, "confidence", confidence, "max_iterations", maxIterations, "seed", seed, "max_yaw_rate", maxYawRate);
    readFields(fn, "max_speed", maxSpeed, "wall_distance", wallDistance, "road_ratio", roadRatio);
    readFields(fn, "wall_distance_log_sigma", wallDistanceLogSigma);
    readFields(fn, "scale_from_road", scaleFromRoad, "gravity_sigma", gravitySigma);
    readFields(fn, "vehicle_pitch_sigma", vehiclePitchSigma, "wall_deviation_sigma", wallDeviationSigma);
    readFields(fn, "prior_yaw_rate", priorYawRate, "prior_speed", priorSpeed);
    readFields(fn, "prior_speed_log_sigma", priorSpeedLogSigma, "prior_wall_distance", priorWallDistance);
    readFields(fn, "prior_wall_distance_log_sigma", priorWallDistanceLogSigma);
    readFields(fn, "prior_speed_wall_correlation", priorSpeedWallCorrelation);
    readFields(fn, "prior_wall_ratio_log_sigma", priorWallRatioLogSigma, "prior_readout_time", priorReadoutTime);
    readFields(fn, "prior_readout_time_log_sigma", priorReadoutTimeLogSigma, "prior_height", priorHeight);
    readFields(fn, "prior_height_log_sigma", priorHeightLogSigma, "standing_probability", standingProbability);
    readFields(fn, "reverse_probability", reverseProbability, "harm_aversion", harmAversion);
}

// Of 10 two sigmas are a factor of 5e8: nothing is known, and the mean of the value, e^50 medians, is still a number.
static void checkLogSigma(double value, const char* name)
{
    REJECT_IF(!(value > 0 && value <= 10), "%s is %g; a number above 0 and up to 10 is expected", name, value);
}

void AckermannEstimator::Params::check() const
{
    REJECT_IF(model != MODEL_AUTO && model != MODEL_NONE && model != MODEL_1LA && model != MODEL_3LA &&
                  model != MODEL_4LA,
              "params.model is %d; one of the MotionModel values -1, 0, 1, 3, 4 is expected", model);
    checkDetector(detector, "params.detector");
    checkPositive(minLength, "params.minLength");
    checkPositive(maxSlant, "params.maxSlant");
    checkNotNegative(slantTolerance, "params.slantTolerance", "none");
    REJECT_IF(minCandidates < 1, "params.minCandidates is %d; a number of 1 or more is expected", minCandidates);
    checkPositive(threshold, "params.threshold");
    checkProbability(confidence, "params.confidence");
    REJECT_IF(maxIterations < 1, "params.maxIterations is %d; a number of 1 or more is expected", maxIterations);
    checkPositive(maxYawRate, "params.maxYawRate");
    checkPositive(maxSpeed, "params.maxSpeed");
    checkNotNegative(wallDistance, "params.wallDistance", "unknown");
    checkNotNegative(wallDistanceLogSigma, "params.wallDistanceLogSigma", "exact");
    if (wallDistanceLogSigma > 0)
        checkLogSigma(wallDistanceLogSigma, "params.wallDistanceLogSigma");
    checkNotNegative(roadRatio, "params.roadRatio", "what is usual");
    checkNotNegative(gravitySigma, "params.gravitySigma", "exact");
    checkPositive(vehiclePitchSigma, "params.vehiclePitchSigma");
    checkNotNegative(wallDeviationSigma, "params.wallDeviationSigma", "unknown");
    checkPositive(priorYawRate, "params.priorYawRate");
    checkPositive(priorSpeed, "params.priorSpeed");
    checkLogSigma(priorSpeedLogSigma, "params.priorSpeedLogSigma");
    checkPositive(priorWallDistance, "params.priorWallDistance");
    checkLogSigma(priorWallDistanceLogSigma, "params.priorWallDistanceLogSigma");
    REJECT_IF(!(std::abs(priorSpeedWallCorrelation) < 1),
              "params.priorSpeedWallCorrelation is %g; a number between -1 and 1 is expected",
              priorSpeedWallCorrelation);
    checkLogSigma(priorWallRatioLogSigma, "params.priorWallRatioLogSigma");
    checkPositive(priorReadoutTime, "params.priorReadoutTime");
    checkLogSigma(priorReadoutTimeLogSigma, "params.priorReadoutTimeLogSigma");
    checkPositive(priorHeight, "params.priorHeight");
    checkLogSigma(priorHeightLogSigma, "params.priorHeightLogSigma");
    checkProbability(standingProbability, "params.standingProbability");
    REJECT_IF(!(reverseProbability > 0 && reverseProbability <= 1),
              "params.reverseProbability is %g; a number above 0 and up to 1 is expected", reverseProbability);
    checkNotNegative(harmAversion, "params.harmAversion", "the residual alone");
}

}} // namespace cv::rsackermann
