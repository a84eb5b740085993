// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../single/inliers_and_scale.hpp"
#include "../single/displacement_field.hpp"
#include "sequence_estimator.hpp"
#include "offset_fit.hpp"

namespace cv { namespace rsackermann {

SequenceEstimator::SequenceEstimator(const RollingShutterCamera& camera_, const AckermannEstimator::Params& params_,
                                     const Ptr<AckermannEstimator>& single_)
    : camera(camera_), params(params_), single(single_), filter(camera_, params_), last(filter.state),
      seen(std::numeric_limits<double>::quiet_NaN())
{
}

void SequenceEstimator::set(const RollingShutterCamera& camera_, const AckermannEstimator::Params& params_)
{
    // Its uncertainty is that of gravity.
    const bool isSameGravity = camera_.uprightRotation == camera.uprightRotation &&
                               params_.gravitySigma == params.gravitySigma &&
                               params_.vehiclePitchSigma == params.vehiclePitchSigma;
    const int kept = isSameGravity ? SEQUENCE_VALUES : SEQUENCE_ROLL;
    const SequenceState before = filter.state;
    camera = camera_;
    params = params_;
    filter.state = SequenceState(camera, params);
    for (int i = 0; i < kept; i++)
    {
        filter.state.value[i] = before.value[i];
        for (int j = 0; j < kept; j++)
            filter.state.covariance(i, j) = before.covariance(i, j);
    }
}

void SequenceEstimator::reset()
{
    features.reset();
    filter.hasFrame = false;
    resetState();
}

void SequenceEstimator::resetState()
{
    filter.reset(camera, params);
    rates = RowRates();
    seen = std::numeric_limits<double>::quiet_NaN();
}

AckermannMotion SequenceEstimator::estimate(const GrayFrame& frame, const GrayFrame& next, const Mat& segments,
                                            const MotionPrior& prior, Mat& labels)
{
    AckermannMotion motion;
    if (estimateFromPoints(frame, next, segments, prior, motion, labels))
        return motion;
    motion = estimateAlone(segments, prior, labels);
    if (motion.status == MOTION_TOO_FEW_SEGMENTS)
        expectMotion(prior, motion, labels);
    return motion;
}

// Returns whether there were points to go by.
bool SequenceEstimator::estimateFromPoints(const GrayFrame& frame, const GrayFrame& next, const Mat& segments,
                                           const MotionPrior& prior, AckermannMotion& motion, Mat& labels)
{
    const double passed = frame.seconds - filter.time;
    if (!filter.isFollowedBy(frame.seconds))
        reset();
    const bool follows = filter.advance(frame.seconds, camera, params);
    const bool isTimed = camera.isRowShutter() && camera.secondsPerUnitTime() > 0;
    features.track(camera, isTimed ? frame : GrayFrame(), passed, next);
    filter.state.measure(prior);
    if (features.bearings.size() < LEAST_POINTS)
    {
        if (follows && features.hasManyPoints())
            resetState();
        return false;
    }
    features.setSegments(camera, params, segments);
    if (!filter.update(features, camera, params, last))
    {
        resetState();
        return false;
    }
    seen = filter.time;
    updateRates(follows ? passed : 0, next.gray.empty() ? 0 : next.seconds - frame.seconds);
    const std::vector<UprightSegment>& verticals = features.verticals;
    labels = Mat(segments.rows, 1, CV_8U, Scalar(SEGMENT_REJECTED));
    for (size_t i = 0; i < verticals.size(); i++)
        labels.at<uchar>(verticals[i].index) = SEGMENT_OUTLIER;
    report(last, verticals, prior, motion, labels);
    const std::vector<TrackedBearing>& fine = features.fineBearings;
    if (motion.status == MOTION_OK)
        fitOffset(camera, fine.size() < LEAST_POINTS ? features.bearings : fine, last.values, motion);
    return true;
}

// From the turns to the neighbours in which points are seen, if one of them is the frame before.
void SequenceEstimator::updateRates(double before, double after)
{
    bool isSeen[2] = {false, false}; // in the earlier and in the later neighbour
    for (size_t i = 0; i < features.bearings.size(); i++)
        isSeen[features.bearings[i].pitch == FLOW_PITCH_BEFORE ? 0 : 1] = true;
    if (before != 0 && isSeen[before > 0 ? 0 : 1])
        rates.update(last, before, isSeen[before > 0 ? 1 : 0] ? after : 0);
    else
        rates.interrupt();
}

// Points aren't spread as pixels are: they show the share of the displacement that is left.
Model SequenceEstimator::predictDisplacement(const SequenceFit& fit, AckermannMotion& motion) const
{
    const double unit = camera.secondsPerUnitTime();
    Matx<double, PARAMETERS, SEQUENCE_VALUES> byValues;
    const SequenceVector& value = fit.state.value;
    const Model model = toModel(value, unit, &byValues);
    const double G = value[SEQUENCE_SPEED] * unit * value[SEQUENCE_ROAD];
    Matx<double, 1, SEQUENCE_VALUES> roadByValues;
    roadByValues(0, SEQUENCE_SPEED) = unit * value[SEQUENCE_ROAD];
    roadByValues(0, SEQUENCE_ROAD) = unit * value[SEQUENCE_SPEED];
    std::vector<Point2d> places;
    for (size_t i = 0; i < features.bearings.size(); i++)
        places.push_back(features.bearings[i].now);
    const DisplacementField field(camera, places);
    DisplacementField::Values displacement;
    DisplacementField::Variances variances;
    field.displacement(model, G, displacement);
    field.addTilt(motion.pitchRate, motion.rollRate, displacement);
    field.variance(model, G, (roadByValues * fit.state.covariance * roadByValues.t())(0),
                   byValues * fit.state.covariance * byValues.t(), variances);
    field.addTiltVariance(motion.pitchRateSigma, motion.rollRateSigma, variances);
    motion.expectedRaw = DisplacementField::meanDistance(displacement, DisplacementField::Values(), variances);
    const double unknown = DisplacementField::meanDistance(displacement, displacement, variances);
    motion.expectedResidual = std::hypot(unknown, motion.expectedRaw * fit.left);
    return model;
}

void SequenceEstimator::report(const SequenceFit& fit, const std::vector<UprightSegment>& verticals,
                               const MotionPrior& prior, AckermannMotion& motion, Mat& labels) const
{
    motion.candidates = int(verticals.size());
    AckermannMotion found = motion;
    fit.state.toMotion(camera.secondsPerUnitTime(), found);
    rates.toMotion(camera.secondsPerUnitTime(), found);
    const Model model = predictDisplacement(fit, found);
    if (!fit.moves || !(found.expectedResidual < found.expectedRaw))
    {
        motion.expectedRaw = motion.expectedResidual = found.expectedRaw;
        return;
    }
    motion = found;
    motion.status = MOTION_OK;
    // A longer lens sees less of a turn.
    const double change = motion.alpha * camera.focalSigma / camera.cameraMatrix(0, 0);
    motion.covariance(0, 0) += change * change;
    motion.model = DisplacementField(camera).mainMotion(model, motion.roadSlope);
    const Agreement agreement = {camera.cameraMatrix(0, 0), params.threshold, PRIOR_LEAN};
    labelInliers(verticals, model, camera.heading, agreement, motion, labels);
    if (!setGivenScale(camera, params, prior, motion) && params.scaleFromRoad && camera.height > 0)
    {
        motion.scale = SCALE_ROAD;
        const bool hasLeft = fit.state.value[SEQUENCE_LEFT] > 0;
        motion.wallDistance =
            1 / std::max(fit.state.value[hasLeft ? SEQUENCE_LEFT : SEQUENCE_RIGHT], double(FLT_EPSILON));
    }
}

// The motion that the frames of the last second let expect of the present one; changed only if one is expected and
// helps.
void SequenceEstimator::expectMotion(const MotionPrior& prior, AckermannMotion& motion, Mat& labels)
{
    if (!(std::abs(filter.time - seen) < LONGEST_INTERVAL))
        return;
    rates.interrupt();
    SequenceFit expected = last;
    expected.state = filter.state;
    AckermannMotion result;
    report(expected, std::vector<UprightSegment>(), prior, result, labels);
    if (result.status != MOTION_OK)
        return;
    result.candidates = motion.candidates;
    motion = result;
}

// From the image alone, with the yaw rate of the frames before, and for the frames after.
AckermannMotion SequenceEstimator::estimateAlone(const Mat& segments, MotionPrior prior, Mat& labels)
{
    SequenceState& state = filter.state;
    if (!filter.isUninitialised)
    {
        // A given yaw rate is in the state already.
        prior.yawRate = state.value[SEQUENCE_YAW_RATE];
        prior.yawRateSigma = std::sqrt(state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE));
    }
    const AckermannMotion motion = single->estimate(segments, labels, prior);
    double yawRate;
    // An unknown gravity misleads all frames in the same way: they can't confirm one another.
    if (params.gravitySigma > 0 || motion.status != MOTION_OK || !motion.yawRate(camera, yawRate))
        return motion;
    filter.isUninitialised = false;
    state.value[SEQUENCE_YAW_RATE] = yawRate;
    for (int i = 0; i < SEQUENCE_VALUES; i++)
        state.covariance(SEQUENCE_YAW_RATE, i) = state.covariance(i, SEQUENCE_YAW_RATE) = 0;
    state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE) = motion.metricCovariance(camera)(0, 0);
    return motion;
}

}} // namespace cv::rsackermann
