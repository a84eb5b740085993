// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "../motion/contradiction.hpp"
#include "../single/depth_alignment.hpp"
#include "../single/inliers_and_scale.hpp"
#include "copies.hpp"
#include "expected_displacement.hpp"
#include "image_with_gyro.hpp"
#include "point_prediction.hpp"
#include "scene_fit.hpp"
#include "sequence_estimator.hpp"

namespace cv { namespace rsackermann {

SequenceMemory::SequenceMemory(const RollingShutterCamera& camera, const AckermannEstimator::Params& params)
    : filter(camera, params), rates(RowRates::usualSteering(params)), last(filter.state), alone(filter.state),
      seen(std::numeric_limits<double>::quiet_NaN()), stillSince(seen)
{
}

void SequenceMemory::change(const CameraVector& difference)
{
    filter.state.change(difference);
    for (SequenceFit* fit : {&last, &alone})
    {
        const SequenceVector values = fit->state.byCamera * difference;
        fit->state.change(difference);
        fit->prediction.change(difference);
        for (int i = 0; i < SEQUENCE_VALUES; i++)
            fit->values[i] += values[i];
    }
}

SequenceEstimator::SequenceEstimator(const RollingShutterCamera& camera_, const AckermannEstimator::Params& params_,
                                     const Ptr<AckermannEstimator>& single_)
    : SequenceMemory(camera_, params_), camera(camera_), turnedCamera(camera_), params(params_), single(single_),
      kept(*this)
{
}

void SequenceEstimator::set(const RollingShutterCamera& camera_, const AckermannEstimator::Params& params_)
{
    // Its uncertainty is that of gravity.
    const bool isSameGravity = camera_.uprightRotation == camera.uprightRotation &&
                               camera_.rollSigma == camera.rollSigma && camera_.pitchSigma == camera.pitchSigma &&
                               params_.gravitySigma == params.gravitySigma &&
                               params_.vehiclePitchSigma == params.vehiclePitchSigma;
    const int sameValues = isSameGravity ? SEQUENCE_VALUES : SEQUENCE_ROLL;
    if (!isSameGravity)
        image.release();
    camera = turnedCamera = camera_;
    turnCamera(curvature);
    params = params_;
    expectByCamera(sameValues);
}

void SequenceEstimator::expectByCamera(int sameValues)
{
    for (SequenceFilter* f : {&filter, &kept.filter})
        f->state.change(straightCamera(), params, sameValues);
}

void SequenceEstimator::reset()
{
    features.reset();
    image.release();
    gyro.reset();
    contradicted = ContradictedValues();
    seenCamera = SeenCamera();
    cameraChange = CameraVector();
    turnCamera(0);
    filter.hasFrame = isKnown = isRepeated = false;
    interval = 0;
    resetState();
}

void SequenceEstimator::resetState()
{
    filter.reset(straightCamera(), params);
    rates = RowRates(RowRates::usualSteering(params));
    clockNoise = ClockNoise();
    seen = stillSince = std::numeric_limits<double>::quiet_NaN();
}

static bool isSame(const Mat& a, const Mat& b)
{
    return a.size() == b.size() && (a.empty() || norm(a, b, NORM_INF) == 0);
}

AckermannMotion SequenceEstimator::estimate(const GrayFrame& frame, const GrayFrame& next, const Mat& segments,
                                            const MotionPrior& prior, Mat& labels)
{
    // The same image again isn't one of a car that stands, unless that is known: it has the same motion.
    const bool isFirst = !image.empty() && !std::isfinite(seen), moved = isKnown && motionOfImage.status == MOTION_OK;
    if ((isFirst || moved) && isSame(frame.gray, image) && isSame(segments, segmentsOfImage))
    {
        isRepeated = true;
        if (isFirst) // what is given, and what a gyro measures, may have changed
            return estimateSingle(frame.seconds, segments, prior, labels);
        labels = labelsOfImage.clone();
        return motionOfImage;
    }
    // As the next one it tells nothing either.
    const bool isNextSame = isSame(frame.gray, next.gray);
    motionOfImage = estimateNew(frame, isNextSame ? GrayFrame() : next, segments, prior, labels);
    labelsOfImage = labels.clone();
    segmentsOfImage = segments.clone();
    frame.gray.copyTo(image);
    return motionOfImage;
}

// What is known of yaw rate and speed, as if it were given.
static MotionPrior valuesOf(const RollingShutterCamera& camera, const AckermannMotion& motion)
{
    MotionPrior known;
    if (motion.yawRate(camera, known.yawRate))
        known.yawRateSigma = std::sqrt(motion.metricCovariance(camera)(0, 0));
    if (motion.speedSigma > 0 && motion.speed(camera, known.speed))
        known.speedSigma = motion.speedSigma;
    return known;
}

AckermannMotion SequenceEstimator::estimateNew(const GrayFrame& frame, const GrayFrame& next, const Mat& segments,
                                               const MotionPrior& prior, Mat& labels)
{
    AckermannMotion motion;
    isKnown = estimateFromPoints(frame, next, segments, prior, motion, labels);
    const bool isAfterCopy = isRepeated;
    isRepeated = isCopy;
    if (isKnown)
        return motion;
    labels = Mat(segments.rows, 1, CV_8U, Scalar(SEGMENT_REJECTED));
    selectCandidates(segments, camera, params, features.verticals, features.others);
    motion.candidates = int(features.verticals.size());
    if (isCopy && motionOfImage.status == MOTION_OK && !image.empty()) // of the same gravity
    {
        const int candidates = motion.candidates;
        motion = motionOfImage;
        motion.candidates = candidates;
    }
    else
        expectMotion(prior, motion, labels);
    isKnown = motion.status == MOTION_OK && (isAfterCopy || isCopy);
    priorOfImage = valuesOf(camera, motion);
    if (motion.status == MOTION_OK)
        return motion;
    motion = estimateAlone(frame.seconds, segments, prior, labels);
    if (motion.status != MOTION_OK)
        turnAlone(frame.seconds, prior, motion);
    return motion;
}

AckermannMotion SequenceEstimator::estimateSingle(double seconds, const Mat& segments, const MotionPrior& prior,
                                                  Mat& labels)
{
    AckermannMotion motion = estimateImage(seconds, segments, prior, labels);
    if (motion.status != MOTION_OK)
        turnAlone(seconds, prior, motion);
    return motion;
}

// By its verticals.
AckermannMotion SequenceEstimator::estimateImage(double seconds, const Mat& segments, const MotionPrior& prior,
                                                 Mat& labels)
{
    priorOfImage = prior;
    MeasuredTurns turns;
    return measure(seconds, turns) ? estimateWithGyro(*single, camera, turns, segments, priorOfImage, labels)
                                   : single->estimate(segments, labels, prior);
}

void SequenceEstimator::turnAlone(double seconds, const MotionPrior& prior, AckermannMotion& motion) const
{
    MeasuredTurns turns;
    if (measure(seconds, turns))
        turnByGyro(camera, params, turns, prior, motion);
}

// Seconds in which a frame is read.
static double readOut(const RollingShutterCamera& camera)
{
    return camera.lineDelay * camera.imageSize.height;
}

// What has moved since images that were copies did so since the first of them, whose motion says nothing. Returns by
// how many seconds that was earlier.
double SequenceEstimator::putBackCopies(double passed)
{
    const double since = (filter.time - stillSince) - passed;
    if (!mayFollowCopies(features.bearings, passed, since))
        return 0;
    features.putBack(camera, passed, since);
    const SequenceFit fit = fitFrame(turnedCamera, features.bearings, features.verticals,
                                     SequenceState(turnedCamera, params), true, FitNuisances());
    if (!movesTooSoon(fit, passed + since))
    {
        features.putBack(camera, passed, -since);
        return 0;
    }
    resetState();
    interval = std::abs(passed + since);
    return since;
}

// Returns whether there were points to go by.
bool SequenceEstimator::estimateFromPoints(const GrayFrame& frame, const GrayFrame& next, const Mat& segments,
                                           const MotionPrior& prior, AckermannMotion& motion, Mat& labels)
{
    isCopy = false;
    double passed = frame.seconds - filter.time;
    const double intervalBefore = interval;
    if (!filter.isFollowedBy(frame.seconds))
        reset();
    const FrameFeatures::Link link =
        features.track(camera, camera.isRowShutter() ? frame : GrayFrame(), passed,
                       predictPoints(turnedCamera, params, filter, features.isKept() ? &kept.filter : 0), next);
    const bool isFrameMissing = interval > 0 && std::abs(passed) > 1.5 * interval && !isRepeated,
               isUsual = std::abs(std::abs(passed) - interval) < 0.1 * interval;
    if (link == FrameFeatures::FOLLOWS)
        interval = std::abs(passed);
    if (link == FrameFeatures::LOST)
        kept = *this;
    if (link == FrameFeatures::BRIDGED)
    {
        SequenceMemory::operator=(kept);
        passed = frame.seconds - filter.time;
    }
    // Where frames are missing, or were lost themselves, one that isn't found again may well be of the same scene.
    else if (link == FrameFeatures::LOST && features.isFirstOfScene() && !isFrameMissing)
        resetState();
    if (isRepeated && seen == filter.time && !isStill(features.bearings) && !isUsual)
        // By when the car has gone on isn't known, unless all images come again.
        features.leaveOut(passed);
    const SequenceFilter filterBefore = filter;
    const bool follows = filter.advance(frame.seconds, straightCamera(), params);
    turnCamera(curvatureOf(filter.state.value[SEQUENCE_YAW_RATE], filter.state.value[SEQUENCE_SPEED]));
    double before = follows ? passed : 0;
    double after = next.gray.empty() ? 0 : next.seconds - frame.seconds;
    if (stopsOrStartsAtOnce(features.bearings))
    {
        features.leaveOut(-after);
        after = 0;
    }
    const bool hasPoints = features.bearings.size() >= LEAST_POINTS;
    if (!hasPoints)
    {
        clockNoise.interrupt();
        return false;
    }
    selectCandidates(segments, camera, params, features.verticals, features.others);
    if (follows)
        before += putBackCopies(passed);
    AckermannMotion compared;
    MotionPrior used = prior;
    FitNuisances nuisances;
    rates.expectChanges(follows ? before : after, nuisances);
    nuisances.interval = clockNoise.sigma();
    nuisances.curvature = curvature;
    nuisances.readoutRatio = seenCamera.readoutRatio();
    SequenceFilter predicted = filter;
    const bool isSeen = filter.update(features, turnedCamera, params, alone, nuisances);
    isCopy = isSeen && showsCopy(alone, features.bearings, passed, prior);
    if (isCopy)
    {
        filter = filterBefore; // at the time of that image
        interval = intervalBefore;
        clockNoise.interrupt();
        stillSince = std::numeric_limits<double>::quiet_NaN();
        return false;
    }
    if (isSeen)
        predicted.state.change(learnCamera(std::abs(before != 0 ? before : after) / readOut(camera)));
    if (!useGiven(isSeen, predicted, rates.aboutFit(before, after, readOut(camera)), nuisances, used, compared))
    {
        resetState();
        return false;
    }
    seen = filter.time;
    if (!isStillSince(features.bearings, passed))
        stillSince = std::numeric_limits<double>::quiet_NaN();
    else if (!std::isfinite(stillSince))
        stillSince = filterBefore.time;
    updateRates(predicted.state, before, after);
    const std::vector<UprightSegment>& verticals = features.verticals;
    labels = Mat(segments.rows, 1, CV_8U, Scalar(SEGMENT_REJECTED));
    for (size_t i = 0; i < verticals.size(); i++)
        labels.at<uchar>(verticals[i].index) = SEGMENT_OUTLIER;
    motion = compared;
    report(last, verticals, used, motion, labels);
    const std::vector<TrackedBearing>& fine = features.fineBearings;
    if (motion.status == MOTION_OK)
        fitOffset(turnedCamera, fine.size() < LEAST_POINTS ? features.bearings : fine, last.values, motion);
    return true;
}

// A sigma that is 0 is none.
static void widen(double& sigma, double other)
{
    if (sigma > 0)
        sigma = std::hypot(sigma, other);
}

// Returns by how much its values change.
CameraVector SequenceEstimator::learnCamera(double longestNow)
{
    seenCamera.add(alone.camera, cameraChange, longestNow);
    const CameraVector found = seenCamera.difference(camera.headingSigma), difference = found - cameraChange;
    cameraChange = found;
    turnCamera(curvature);
    change(difference);
    kept.change(difference);
    expectByCamera(SEQUENCE_VALUES); // as after set(), without the rounding of sums
    return difference;
}

void SequenceEstimator::turnCamera(double curvature_)
{
    curvature = curvature_;
    turnedCamera.heading = camera.heading + cameraChange[CAMERA_HEADING] + curvature * cameraChange[CAMERA_LEVER];
}

// A street goes on along the car's axis, in bends too.
RollingShutterCamera SequenceEstimator::straightCamera() const
{
    RollingShutterCamera result = camera;
    result.heading += cameraChange[CAMERA_HEADING];
    return result;
}

SequenceState SequenceEstimator::marginal(const SequenceState& state) const
{
    return state.marginal(seenCamera.covariance(camera.headingSigma));
}

// What is given counts in its own frame alone: its error may be that of all frames. Goes by the frames without what
// they contradict, or alone if no motion is near what is given. Returns whether they show one of this scene.
bool SequenceEstimator::useGiven(bool isSeen, const SequenceFilter& predicted, const AboutFit& aboutFit,
                                 const FitNuisances& nuisances, MotionPrior& prior, AckermannMotion& motion)
{
    last = alone;
    if (!isGiven(prior))
        return isSeen;
    if (isSeen)
        prior = compareWithSeen(alone, prior, aboutFit, motion);
    // Points show means, and what is given is of the instant.
    MotionPrior given = prior;
    widen(given.yawRateSigma, aboutFit.yawRate);
    widen(given.speedSigma, aboutFit.speed);
    SequenceFilter aided = predicted;
    aided.state.measure(given);
    const bool isNear = isGiven(given) && aided.update(features, turnedCamera, params, last, nuisances);
    if (!isSeen)
        alone = last;
    else if (!isNear)
        last = alone;
    return isSeen || isNear;
}

MotionPrior SequenceEstimator::compareWithSeen(const SequenceFit& ofFrames, const MotionPrior& prior,
                                               const AboutFit& aboutFit, AckermannMotion& motion)
{
    const SequenceState state = marginal(ofFrames.state);
    if (prior.yawRateSigma > 0)
        state.seen(SEQUENCE_YAW_RATE, motion.seenYawRate, motion.seenYawRateSigma);
    if (prior.speedSigma > 0)
        state.seen(SEQUENCE_SPEED, motion.seenSpeed, motion.seenSpeedSigma);
    widen(motion.seenYawRateSigma, aboutFit.yawRate);
    widen(motion.seenSpeedSigma, aboutFit.speed);
    AckermannMotion seenMotion;
    ofFrames.state.toMotion(camera.secondsPerUnitTime(), seenMotion);
    motion.direction = seenMotion.direction;
    return contradicted.usable(prior, ofFrames.moves && showsOtherDirection(seenMotion, prior), motion);
}

// From the turns to the neighbours in which points are seen, if one of them is the frame before.
void SequenceEstimator::updateRates(const SequenceState& predicted, double before, double after)
{
    bool isSeen[2] = {false, false}; // in the earlier and in the later neighbour
    for (size_t i = 0; i < features.bearings.size(); i++)
        isSeen[features.bearings[i].pitch == FLOW_PITCH_BEFORE ? 0 : 1] = true;
    const bool hasBefore = before != 0 && isSeen[before > 0 ? 0 : 1],
               hasAfter = after != 0 && isSeen[after > 0 ? 1 : 0];
    if (hasBefore && alone.moves)
        clockNoise.add(alone.values[SEQUENCE_SPEED], before);
    else
        clockNoise.interrupt();
    if (hasBefore)
        rates.update(alone, before, hasAfter ? after : 0, readOut(camera));
    else if (hasAfter)
        rates.begin(alone, after, readOut(camera));
    else
        rates.interrupt();
    if (gyro.samples.empty())
        return;
    const SequenceState uncertain = marginal(last.state);
    const auto varianceOf = [](const SequenceState& state) {
        return state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE);
    };
    // Of the prediction's error, which the frames before have as well, P^2 / P' is left of the variance P'.
    const double share = std::min(varianceOf(alone.state) / varianceOf(predicted), 1.),
                 lasting = varianceOf(uncertain) - (1 - share) * varianceOf(last.state),
                 yawSigma = std::sqrt(varianceOf(uncertain)), lastingSigma = std::sqrt(std::max(lasting, 0.));
    if (hasBefore || hasAfter)
    {
        const double neighbour = hasBefore ? -before : after;
        gyro.add(TurnOfPoints(camera, features.bearings, last.values, neighbour < 0 ? last.before : last.after,
                              filter.time, neighbour, yawSigma, lastingSigma));
    }
    useGyro();
}

// A gyro that the points confirm knows the instant.
void SequenceEstimator::useGyro()
{
    MeasuredTurns turns;
    if (measure(filter.time, turns))
        rates.set(turns);
}

bool SequenceEstimator::measures(double seconds) const
{
    MeasuredTurns turns;
    return measure(seconds, turns);
}

// What a gyro that isn't wrong measures in a frame.
bool SequenceEstimator::measure(double seconds, MeasuredTurns& turns) const
{
    CameraRates now;
    const bool isMeasured = std::isfinite(seconds) && camera.isRowShutter() && camera.secondsPerUnitTime() > 0 &&
                            !gyro.contradicts() && gyro.at(seconds, RowSpan(camera), now);
    if (!isMeasured)
        return false;
    const Matx33d upright = tiltOf(filter.state.value.val) * camera.uprightRotation;
    now.about(upright, turns.pitch, turns.yaw, turns.roll);
    turns.pitch.value = -turns.pitch.value; // looking down is a turn against the x axis
    const double unit = camera.secondsPerUnitTime(), lastRow = camera.imageSize.height - 1;
    turns.curve =
        gyro.curve(seconds, now, unit * camera.rowTime(Point2d()), unit * camera.rowTime(Point2d(0, lastRow)), upright);
    return true;
}

// Points aren't spread as pixels are: they show the residual over the displacement.
Model SequenceEstimator::predictDisplacement(const SequenceFit& fit, AckermannMotion& motion) const
{
    std::vector<Point2d> places;
    for (size_t i = 0; i < features.bearings.size(); i++)
        places.push_back(features.bearings[i].now);
    const Model model = expectDisplacement(DisplacementField(turnedCamera, places), turnedCamera, fit.state, false,
                                           fit.residual, motion);
    expectReadout(seenCamera.readoutContradiction(), motion);
    return model;
}

void SequenceEstimator::report(const SequenceFit& fit_, const std::vector<UprightSegment>& verticals,
                               const MotionPrior& prior, AckermannMotion& motion, Mat& labels) const
{
    motion.candidates = int(verticals.size());
    motion.readoutRatioSigma = seenCamera.readoutRatioSigma();
    if (motion.readoutRatioSigma > 0)
        motion.readoutRatio = seenCamera.readoutRatio();
    motion.seenHeadingSigma = seenCamera.headingSigma();
    if (motion.seenHeadingSigma > 0)
        motion.seenHeading = camera.heading + seenCamera.heading();
    AckermannMotion found = motion;
    found.headingCorrection = turnedCamera.heading - camera.heading;
    SequenceFit fit = fit_;
    rates.toInstant(prior, fit.state);
    const SequenceState uncertain = marginal(fit.state);
    uncertain.toMotion(camera.secondsPerUnitTime(), found);
    rates.toMotion(camera, found);
    const Model model = predictDisplacement(fit, found);
    const bool moves = fit.moves || (!fit.stands && uncertain.excludesRest());
    if (!moves || !(found.expectedResidual < found.expectedRaw))
    {
        motion.expectedRaw = motion.expectedResidual = found.expectedRaw;
        return;
    }
    motion = found;
    motion.status = MOTION_OK;
    // A longer lens sees less of a turn.
    const double change = motion.alpha * camera.focalSigma / camera.cameraMatrix(0, 0);
    motion.covariance(0, 0) += change * change;
    motion.model = DisplacementField(turnedCamera).mainMotion(model, motion.roadSlope);
    const Agreement agreement = {camera.cameraMatrix(0, 0), params.threshold, PRIOR_LEAN};
    labelInliers(verticals, model, turnedCamera.heading, agreement, motion, labels);
    keepSeenWalls(camera, motion);
    if (!setGivenScale(camera, params, prior, motion) && params.scaleFromRoad && camera.height > 0)
        motion.scale = SCALE_ROAD;
    if (motion.scale == SCALE_ROAD || motion.scale == SCALE_SPEED) // by what is given and what the frames show
    {
        const double way = std::abs(fit.state.value[SEQUENCE_SPEED]) * camera.secondsPerUnitTime();
        motion.wallDistance =
            way / std::max(std::hypot(motion.wallSlope, motion.wallOffset), way * FLT_EPSILON + DBL_MIN);
        motion.speedSigma = std::sqrt(uncertain.covariance(SEQUENCE_SPEED, SEQUENCE_SPEED));
    }
}

// The motion that the frames of the last second let expect of the present one; changed only if one is expected and
// helps.
void SequenceEstimator::expectMotion(const MotionPrior& prior, AckermannMotion& motion, Mat& labels)
{
    if (!(std::abs(filter.time - seen) < LONGEST_INTERVAL))
        return;
    rates.interrupt();
    useGyro();
    SequenceFit expected = last;
    expected.state = filter.state;
    AckermannMotion result;
    const MotionPrior used = compareWithSeen(expected, prior, AboutFit(), result);
    expected.state.measure(used);
    report(expected, std::vector<UprightSegment>(), used, result, labels);
    if (result.status != MOTION_OK)
        return;
    result.candidates = motion.candidates;
    motion = result;
}

bool SequenceEstimator::alignDepth(const Mat& segments, AckermannMotion& motion, DepthMap& depth) const
{
    RollingShutterCamera ofMotion = camera;
    ofMotion.heading = motion.heading(camera);
    if (!isSeen())
        return rsackermann::alignDepth(ofMotion, params, priorOfImage, segments, motion, depth);
    DepthFit found;
    DepthMap aligned = depth;
    if (motion.status != MOTION_OK || !fitDepth(ofMotion, features.bearings, last, motion, aligned, found))
        // Where hardly any point has a depth none speaks against one in metres.
        return depth.kind == DEPTH_METRIC && found.points < LEAST_POINTS &&
               rsackermann::alignDepth(ofMotion, params, valuesOf(camera, motion), segments, motion, depth);
    AckermannMotion changed = motion;
    MeasuredTurns turns;
    const double unit = camera.secondsPerUnitTime() / 2;
    if (!measure(filter.time, turns)) // a gyro knows the instant, whatever the scene is
    {
        const double before = motion.covariance(0, 0),
                     ofPlanes = last.state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE);
        changed.alpha += unit * (found.yawRate - last.values[SEQUENCE_YAW_RATE]);
        setAlphaVariance(before + unit * unit * (found.covariance(0, 0) - ofPlanes), changed);
    }
    // What the heading adds to the yaw the way aside takes away.
    const double ofCamera = marginal(last.state).covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE) -
                            last.state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE),
                 ofAlpha = std::max(changed.covariance(0, 0) - unit * unit * ofCamera, 0.);
    const Matx33d toAlpha = Matx33d::diag(Vec3d(std::sqrt(ofAlpha / found.covariance(0, 0)), 1, 1));
    std::vector<Point2d> places;
    for (const TrackedBearing& b : features.bearings)
        places.push_back(b.now);
    expectWithDepth(ofMotion, depth, found.scale, found.shift, toAlpha * found.covariance * toAlpha, places, motion,
                    changed);
    changed.expectedResidual = std::hypot(changed.expectedResidual, changed.expectedRaw * found.residual);
    changed.probabilityWorse = DisplacementField::probabilityWorse(changed.expectedRaw, changed.expectedResidual);
    expectReadout(seenCamera.readoutContradiction(), changed);
    if (!(changed.expectedResidual < changed.expectedRaw))
        return false;
    motion = changed;
    depth = aligned;
    return true;
}

// From the image alone, with the yaw rate of the frames before, and for the frames after.
AckermannMotion SequenceEstimator::estimateAlone(double seconds, const Mat& segments, const MotionPrior& given,
                                                 Mat& labels)
{
    SequenceState& state = filter.state;
    MotionPrior prior = given;
    if (!filter.isUninitialised)
    {
        SequenceState expected = state;
        expected.measure(given);
        expected = marginal(expected);
        expected.seen(SEQUENCE_YAW_RATE, prior.yawRate, prior.yawRateSigma);
    }
    AckermannMotion motion = estimateImage(seconds, segments, prior, labels);
    if (!filter.isUninitialised)
        compareAgain(prior, given, motion);
    double yawRate;
    // An unknown gravity misleads all frames in the same way: they can't confirm one another.
    if (isGiven(given) || params.gravitySigma > 0 || motion.status != MOTION_OK || !motion.yawRate(camera, yawRate))
        return motion;
    filter.isUninitialised = false;
    state.value[SEQUENCE_YAW_RATE] = yawRate;
    for (int i = 0; i < SEQUENCE_VALUES; i++)
        state.covariance(SEQUENCE_YAW_RATE, i) = state.covariance(i, SEQUENCE_YAW_RATE) = 0;
    state.covariance(SEQUENCE_YAW_RATE, SEQUENCE_YAW_RATE) = motion.metricCovariance(camera)(0, 0);
    return motion;
}

}} // namespace cv::rsackermann
