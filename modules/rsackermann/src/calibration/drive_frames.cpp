// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "drive_frames.hpp"
#include "../motion/contradiction.hpp"
#include "../sequence/frame_terms.hpp"
#include "../sequence/point_prediction.hpp"

namespace cv { namespace rsackermann {

DriveFrames::DriveFrames(const RollingShutterCamera& given, const AckermannEstimator::Params& gates_, int maxFrames_)
    : camera_(given), gates(gates_), maxFrames(maxFrames_), filter(given, gates_), unaided(filter)
{
    camera_.rollSigma = camera_.pitchSigma = 0; // gates.gravitySigma is what isn't known of its tilt
}

bool DriveFrames::add(const GrayFrame& frame, const Mat& segments, const MotionPrior& ofInstant)
{
    return addAt(frame.seconds, segments, ofInstant, [&](double passed) {
        const FrameFeatures::Link link = features.track(camera_, frame, passed, predictPoints(camera_, gates, filter));
        if (link == FrameFeatures::BRIDGED) // the interval is that to the frame before
            features.leaveOut(passed);
    });
}

static bool isInImage(const Point2d& p, const Size& size)
{
    return p.x >= -0.5 && p.y >= -0.5 && p.x <= size.width - 0.5 && p.y <= size.height - 0.5;
}

bool DriveFrames::add(const Mat& points, const Mat& segments, double seconds, const MotionPrior& ofInstant)
{
    std::vector<PointPair> pairs;
    for (int i = 0; i < points.rows; i++)
    {
        const double* p = points.ptr<double>(i);
        const PointPair pair = {Point2d(p[0], p[1]), Point2d(p[2], p[3])};
        if (isInImage(pair.other, camera_.imageSize) && isInImage(pair.now, camera_.imageSize))
            pairs.push_back(pair);
    }
    return addAt(seconds, segments, ofInstant, [&](double passed) { features.setPoints(camera_, pairs, passed); });
}

static void average(double other, double otherSigma, double& value, double& sigma)
{
    if (!(sigma > 0 && otherSigma > 0))
        return;
    value = (value + other) / 2;
    sigma = (sigma + otherSigma) / 2; // as of a sensor that errs in both alike
}

// Points show means between two frames, and what is given is of instants.
static MotionPrior meanOf(const MotionPrior& first, const MotionPrior& second)
{
    MotionPrior mean = second;
    average(first.yawRate, first.yawRateSigma, mean.yawRate, mean.yawRateSigma);
    average(first.speed, first.speedSigma, mean.speed, mean.speedSigma);
    return mean;
}

static bool contradictsGiven(const SequenceFit& fit, const MotionPrior& prior)
{
    const auto isContradicted = [&](SequenceValue which, double value, double sigma) {
        return sigma > 0 &&
               contradicts(fit.state.value[which], std::sqrt(fit.state.covariance(which, which)), value, sigma);
    };
    return isContradicted(SEQUENCE_YAW_RATE, prior.yawRate, prior.yawRateSigma) ||
           isContradicted(SEQUENCE_SPEED, prior.speed, prior.speedSigma);
}

// @param setPoints sets the points of the frame, by the seconds since the one before.
template <class SetPoints>
bool DriveFrames::addAt(double seconds, const Mat& segments, const MotionPrior& ofInstant, const SetPoints& setPoints)
{
    const double before = filter.time, passed = seconds - before;
    const MotionPrior prior = meanOf(givenBefore, ofInstant);
    givenBefore = ofInstant;
    // Frames that go back in time are those of another drive.
    if (!(passed > 0))
        filter.hasFrame = false;
    const bool follows = filter.advance(seconds, camera_, gates);
    unaided.hasFrame = follows;
    unaided.advance(seconds, camera_, gates);
    if (!follows)
    {
        features.reset();
        drive++;
    }
    else if (!(camera_.lineDelay > 0))
    {
        camera_.lineDelay = passed / camera_.imageSize.height / 2; // rows take between nothing and all of the time
        filter.reset(camera_, gates);
        unaided.reset(camera_, gates);
    }
    setPoints(passed);
    if (!follows || features.bearings.size() < LEAST_POINTS)
    {
        clock.interrupt();
        return false;
    }
    selectCandidates(segments, camera_, gates, features.verticals, features.others);
    SequenceFit fit(filter.state);
    MotionPrior rest = prior;
    rest.speedSigma = rest.yawRateSigma = 0;
    bool moves = moved(unaided, rest, fit);
    contrary += moves && goesTheOtherWay(fit, prior);
    contradicted += moves && contradictsGiven(fit, prior);
    if (moves)
        clock.add(fit.values[SEQUENCE_SPEED], passed);
    else
        clock.interrupt();
    if (prior.speedSigma > 0 || prior.yawRateSigma > 0)
        moves = moved(filter, prior, fit);
    else
        filter = unaided;
    if (!moves)
        return false;
    keep(frameOf(fit, before, prior));
    return true;
}

// Whether the points of a frame show a motion.
bool DriveFrames::moved(SequenceFilter& of, const MotionPrior& prior, SequenceFit& fit) const
{
    of.state.measure(prior);
    return of.update(features, camera_, gates, fit) && fit.moves;
}

// Than given, or than cars usually go.
bool DriveFrames::goesTheOtherWay(const SequenceFit& fit, const MotionPrior& prior) const
{
    MotionPrior forward;
    forward.speed = 1;
    forward.speedSigma = FLT_EPSILON;
    AckermannMotion seen;
    fit.state.toMotion(camera_.secondsPerUnitTime(), seen);
    return showsOtherDirection(seen, prior.speedSigma > 0 ? prior : forward);
}

CalibrationFrame DriveFrames::frameOf(const SequenceFit& fit, double before, const MotionPrior& prior) const
{
    CalibrationFrame frame;
    frame.drive = drive;
    frame.time = filter.time;
    frame.before = before;
    frame.interval = frame.time - before;
    frame.verticals = features.verticals;
    for (int i = 0; i < FRAME_VALUES; i++)
        frame.value[i] = i < SEQUENCE_VALUES ? fit.state.value[i] : 0;
    frame.bearings = withoutOwnCar(camera_, features.bearings, fit.values);
    SequenceState expected(camera_, gates);
    expected.measure(prior);
    for (int i = 0; i < SCENE_VALUES; i++)
    {
        frame.expected[i] = expected.value[i];
        frame.sigma[i] = std::sqrt(expected.covariance(i, i));
    }
    // Scenes start as they are expected: with an unknown heading the fit of a single frame can take a street for a
    // facade across the way, from where no step leads back.
    std::copy(frame.expected + SEQUENCE_DIRECTION, frame.expected + SCENE_VALUES,
              frame.value.data() + SEQUENCE_DIRECTION);
    return frame;
}

// Of a long drive runs of frames are kept at equal distances, since what connects neighbours shows the suspension:
// as many as one has frames.
void DriveFrames::keep(const CalibrationFrame& frame)
{
    const int run = number++ / int(std::sqrt(maxFrames));
    if (run % stride)
        return;
    frames.push_back(frame);
    numbers.push_back(run);
    while (frames.size() > size_t(maxFrames))
    {
        stride *= 2;
        size_t kept = 0;
        for (size_t i = 0; i < frames.size(); i++)
            if (numbers[i] % stride == 0)
            {
                std::swap(frames[kept], frames[i]);
                numbers[kept++] = numbers[i];
            }
        frames.resize(kept);
        numbers.resize(kept);
    }
}

}} // namespace cv::rsackermann
