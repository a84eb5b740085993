// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../estimator/account.hpp"
#include "../estimator/displacement_field.hpp"
#include "drive_estimator.hpp"
#include "relief_fit.hpp"

namespace cv { namespace rsackermann {

static const size_t MANY_POINTS = 80;    // if next to none of them was there before, it is another scene
static const double LEAST_TRACKED = 0.3; // of the points that a frame has

DriveEstimator::DriveEstimator(const RollingShutterCamera& camera_, const AckermannEstimator::Params& params_)
    : camera(camera_), params(params_), tracker(COARSE_PIXELS), fineTracker(FINE_PIXELS), state(camera_, params_),
      time(0), hasFrame(false), isVague(true), last(state), seen(std::numeric_limits<double>::quiet_NaN())
{
}

void DriveEstimator::set(const RollingShutterCamera& camera_, const AckermannEstimator::Params& params_)
{
    // Its uncertainty is that of gravity.
    const bool isSameGravity = camera_.uprightRotation == camera.uprightRotation &&
                               params_.gravitySigma == params.gravitySigma &&
                               params_.vehiclePitchSigma == params.vehiclePitchSigma;
    const int kept = isSameGravity ? DRIVE_VALUES : DRIVE_ROLL;
    const DriveState before = state;
    camera = camera_;
    params = params_;
    state = DriveState(camera, params);
    for (int i = 0; i < kept; i++)
    {
        state.value[i] = before.value[i];
        for (int j = 0; j < kept; j++)
            state.covariance(i, j) = before.covariance(i, j);
    }
}

void DriveEstimator::reset()
{
    tracker.reset();
    fineTracker.reset();
    hasFrame = false;
    forget();
}

// It is another scene.
void DriveEstimator::forget()
{
    state = DriveState(camera, params);
    isVague = true;
    seen = std::numeric_limits<double>::quiet_NaN();
}

// Points of the frame that are seen in the one before and in the one after.
void DriveEstimator::look(const GrayFrame& frame, const GrayFrame& next, double passed)
{
    sights.clear();
    fineSights.clear();
    if (!camera.isRowShutter() || !(camera.secondsPerUnitTime() > 0) || frame.gray.empty())
        return;
    const double ahead = next.seconds - frame.seconds;
    const bool hasNext = !next.gray.empty() && ahead != 0 && std::abs(ahead) < LONGEST_INTERVAL;
    follow(tracker, frame, passed, hasNext ? &next : 0, sights);
    // A recorded drive has the time for it. In small images it would be the same points.
    if (hasNext && frame.gray.total() > COARSE_PIXELS)
        follow(fineTracker, frame, passed, &next, fineSights);
    else
        fineTracker.reset();
}

// Between frames of different scenes some points find something that looks like them.
void DriveEstimator::follow(PointTracker& points, const GrayFrame& frame, double passed, const GrayFrame* next,
                            std::vector<Sight>& found)
{
    points.track(frame.gray, frame.scale, pairs);
    if (pairs.size() >= LEAST_TRACKED * points.pointCount())
        addSights(camera, pairs, passed, found);
    if (!next)
        return;
    points.trackNext(next->gray, pairs);
    if (pairs.size() >= LEAST_TRACKED * points.pointCount())
        addSights(camera, pairs, frame.seconds - next->seconds, found);
}

bool DriveEstimator::estimate(const GrayFrame& frame, const GrayFrame& next, const Mat& segments,
                              const MotionPrior& prior, AckermannMotion& motion, Mat& labels)
{
    const double passed = frame.seconds - time;
    const bool follows = hasFrame && passed != 0 && std::abs(passed) < LONGEST_INTERVAL;
    if (!follows)
        reset();
    else
        state.predict(std::abs(passed));
    time = frame.seconds;
    hasFrame = true;
    look(frame, next, passed);
    state.measure(DRIVE_YAW_RATE, prior.yawRate, prior.yawRateSigma);
    state.measure(DRIVE_SPEED, prior.speed, prior.speedSigma);
    state.measure(DRIVE_DIRECTION, prior.wallDirection, prior.wallDirectionSigma);
    if (sights.size() < LEAST_POINTS)
    {
        if (follows && tracker.pointCount() > MANY_POINTS)
            forget();
        return false;
    }

    std::vector<UprightSegment> verticals, others;
    selectCandidates(segments, camera, params, verticals, others);
    const DriveFit fit = fitDrive(camera, sights, verticals, state, isVague);
    if (fit.agreeing < LEAST_AGREEING)
    {
        forget();
        return false;
    }
    state = fit.state;
    isVague = false;
    last = fit;
    seen = time;
    labels = Mat(segments.rows, 1, CV_8U, Scalar(SEGMENT_REJECTED));
    for (size_t i = 0; i < verticals.size(); i++)
        labels.at<uchar>(verticals[i].index) = SEGMENT_OUTLIER;
    motion = AckermannMotion();
    report(fit, verticals, prior, motion, labels);
    if (motion.status == MOTION_OK)
        fitRelief(camera, fineSights.size() < LEAST_POINTS ? sights : fineSights, fit.values, motion);
    return true;
}

// Points aren't spread as pixels are: they show the share of the displacement that is left.
Model DriveEstimator::predictDisplacement(const DriveFit& fit, AckermannMotion& motion) const
{
    const double unit = camera.secondsPerUnitTime();
    Matx<double, PARAMETERS, DRIVE_VALUES> byValues;
    const DriveVector& value = fit.state.value;
    const Model model = toModel(value, unit, &byValues);
    const double G = value[DRIVE_SPEED] * unit * value[DRIVE_ROAD];
    Matx<double, 1, DRIVE_VALUES> roadByValues;
    roadByValues(0, DRIVE_SPEED) = unit * value[DRIVE_ROAD];
    roadByValues(0, DRIVE_ROAD) = unit * value[DRIVE_SPEED];
    const DisplacementField field(camera);
    DisplacementField::Values displacement;
    DisplacementField::Variances variances;
    field.displacement(model, G, displacement);
    field.variance(model, G, (roadByValues * fit.state.covariance * roadByValues.t())(0),
                   byValues * fit.state.covariance * byValues.t(), variances);
    motion.expectedRaw = DisplacementField::meanDistance(displacement, DisplacementField::Values(), variances);
    const double unknown = DisplacementField::meanDistance(displacement, displacement, variances);
    motion.expectedLeft = std::hypot(unknown, motion.expectedRaw * fit.left);
    return model;
}

void DriveEstimator::report(const DriveFit& fit, const std::vector<UprightSegment>& verticals, const MotionPrior& prior,
                            AckermannMotion& motion, Mat& labels) const
{
    motion.candidates = int(verticals.size());
    const Model model = predictDisplacement(fit, motion);
    if (!fit.moves || !(motion.expectedLeft < motion.expectedRaw))
    {
        motion.expectedLeft = motion.expectedRaw;
        return;
    }
    motion.status = MOTION_OK;
    fit.state.toMotion(camera.secondsPerUnitTime(), motion);
    // A longer lens sees less of a turn.
    const double change = motion.alpha * camera.focalSigma / camera.cameraMatrix(0, 0);
    motion.covariance(0, 0) += change * change;
    motion.model = DisplacementField(camera).mainMotion(model, motion.roadSlope);
    const Agreement agreement = {camera.cameraMatrix(0, 0), params.threshold, USUAL_LEAN};
    labelInliers(verticals, model, camera.heading, agreement, motion, labels);
    if (!setToldScale(camera, params, prior, motion) && params.scaleFromRoad && camera.height > 0)
    {
        motion.scale = SCALE_ROAD;
        const bool hasLeft = fit.state.value[DRIVE_LEFT] > 0;
        motion.wallDistance = 1 / std::max(fit.state.value[hasLeft ? DRIVE_LEFT : DRIVE_RIGHT], double(FLT_EPSILON));
    }
}

void DriveEstimator::expectMotion(const MotionPrior& prior, AckermannMotion& motion, Mat& labels) const
{
    if (!(std::abs(time - seen) < LONGEST_INTERVAL))
        return;
    DriveFit expected = last;
    expected.state = state;
    AckermannMotion result;
    report(expected, std::vector<UprightSegment>(), prior, result, labels);
    if (result.status != MOTION_OK)
        return;
    result.candidates = motion.candidates;
    motion = result;
}

MotionPrior DriveEstimator::priorOfFrame(const MotionPrior& prior) const
{
    MotionPrior known = prior;
    if (isVague)
        return known;
    // A told yaw rate is in the state already.
    known.yawRate = state.value[DRIVE_YAW_RATE];
    known.yawRateSigma = std::sqrt(state.covariance(DRIVE_YAW_RATE, DRIVE_YAW_RATE));
    return known;
}

void DriveEstimator::learn(const AckermannMotion& motion)
{
    double yawRate;
    // An unknown gravity misleads all frames in the same way: they can't confirm one another.
    if (params.gravitySigma > 0 || motion.status != MOTION_OK || !motion.yawRate(camera, yawRate))
        return;
    isVague = false;
    state.value[DRIVE_YAW_RATE] = yawRate;
    for (int i = 0; i < DRIVE_VALUES; i++)
        state.covariance(DRIVE_YAW_RATE, i) = state.covariance(i, DRIVE_YAW_RATE) = 0;
    state.covariance(DRIVE_YAW_RATE, DRIVE_YAW_RATE) = motion.metricCovariance(camera)(0, 0);
}

}} // namespace cv::rsackermann
