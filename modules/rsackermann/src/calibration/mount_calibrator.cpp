// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "opencv2/rsackermann/calibration.hpp"
#include "../camera/axis_rotations.hpp"
#include "../camera/line_delay_sigma.hpp"
#include "../checks.hpp"
#include "../features/segment_finder.hpp"
#include "../motion/contradiction.hpp"
#include "../storage.hpp"
#include "../sequence/clock_noise.hpp"
#include "../sequence/frame_terms.hpp"
#include "../sequence/point_prediction.hpp"
#include "../sequence/sequence_filter.hpp"
#include "drive_turns.hpp"
#include "mount_solver.hpp"

namespace cv { namespace rsackermann {

// Of the standard deviation before, at most, for a value that is observable
static const double OBSERVED = 0.5;

// Seconds that an image takes, of a line delay to start from: from others a wrong one is found, or none
static const double SHORTEST_START = 0.002, LONGEST_START = 0.1;

MountCalibration::MountCalibration()
    : frames(0), contraryFrames(0), contradictedFrames(0), intervalSigma(0), roll(0), rollSigma(0), pitch(0),
      pitchSigma(0), heading(0), headingSigma(0), lineDelay(0), lineDelaySigma(0), rollObserved(false),
      pitchObserved(false), headingObserved(false), lineDelayObserved(false), gyroFrames(0), gyroDelay(0),
      gyroDelaySigma(0), focalScale(1), focalScaleSigma(0)
{
}

Vec3d MountCalibration::horizon() const
{
    // The rays at right angles to gravity.
    const Vec3d line = camera.cameraMatrix.inv().t() * camera.gravity();
    return line * (1 / std::hypot(line[0], line[1]));
}

MountCalibrator::Params::Params()
    : maxFrames(1000), tiltSigma(3 * CV_PI / 180), headingSigma(5 * CV_PI / 180), lineDelaySigma(0.3),
      suspensionSigma(0.4 * CV_PI / 180), suspensionTime(0.5)
{
}

void MountCalibrator::Params::setEstimatorParams(const AckermannEstimator::Params& params)
{
    estimator = params;
}

AckermannEstimator::Params MountCalibrator::Params::getEstimatorParams() const
{
    return estimator;
}

void MountCalibrator::Params::check() const
{
    estimator.check();
    REJECT_IF(maxFrames < 100, "params.maxFrames is %d; a number of 100 or more is expected", maxFrames);
    checkPositive(tiltSigma, "params.tiltSigma");
    checkPositive(headingSigma, "params.headingSigma");
    checkPositive(lineDelaySigma, "params.lineDelaySigma");
    checkPositive(suspensionSigma, "params.suspensionSigma");
    checkPositive(suspensionTime, "params.suspensionTime");
}

void MountCalibrator::Params::write(FileStorage& fs) const
{
    fs.startWriteStruct("estimator", FileNode::MAP);
    estimator.write(fs);
    fs.endWriteStruct();
    fs << "max_frames" << maxFrames << "tilt_sigma" << tiltSigma << "heading_sigma" << headingSigma
       << "line_delay_sigma" << lineDelaySigma;
    fs << "suspension_sigma" << suspensionSigma << "suspension_time" << suspensionTime;
}

void MountCalibrator::Params::read(const FileNode& fn)
{
    estimator.read(fn["estimator"]);
    readFields(fn, "max_frames", maxFrames, "tilt_sigma", tiltSigma, "heading_sigma", headingSigma);
    readFields(fn, "line_delay_sigma", lineDelaySigma, "suspension_sigma", suspensionSigma);
    readFields(fn, "suspension_time", suspensionTime);
}

namespace {

// Roll and pitch as setRollPitch() takes them, for a unit vector of gravity: its first and last components times its
// length there are their sines.
void rollAndPitchOf(const Vec3d& gravity, double& roll, double& pitch)
{
    const double product = gravity[0] * gravity[2],
                 length2 = 2 / (1 + std::sqrt(std::max(1 - 4 * product * product, 0.)));
    pitch = std::asin(std::min(std::max(gravity[2] * std::sqrt(length2), -1.), 1.));
    roll = std::atan2(gravity[0] * std::cos(pitch), gravity[1]);
}

class MountCalibratorImpl CV_FINAL : public StoredAlgorithm<MountCalibrator>
{
public:
    MountCalibratorImpl(const RollingShutterCamera& camera, const Params& params_)
        : filter(camera, params_.estimator), unaided(filter)
    {
        setParams(params_);
        setCamera(camera);
    }

    void setCamera(const RollingShutterCamera& camera) CV_OVERRIDE
    {
        camera.check();
        REJECT_IF(
            !camera.isRowShutter(),
            "camera.scanDirection is %d; a shutter along the rows, SCAN_TOP_TO_BOTTOM (0) or SCAN_BOTTOM_TO_TOP (1), "
            "is expected",
            camera.scanDirection);
        const int lines = camera.imageSize.height;
        const bool isStart = camera.lineDelay > 0 && !(camera.lineDelaySigma > 0);
        REJECT_IF(isStart && (camera.lineDelay < SHORTEST_START / lines || camera.lineDelay > LONGEST_START / lines),
                  "camera.lineDelay is %g, %g s for %d lines; 0 (unknown), from %g to %g s for all lines, or one whose "
                  "lineDelaySigma is given, is expected",
                  camera.lineDelay, camera.lineDelay * lines, lines, SHORTEST_START, LONGEST_START);
        given = camera;
        removeFrames();
    }

    RollingShutterCamera getCamera() const CV_OVERRIDE { return given; }

    void setParams(const Params& params_) CV_OVERRIDE
    {
        params_.check();
        params = params_;
        gates = params.estimator;
        gates.gravitySigma = gates.vehiclePitchSigma = params.tiltSigma;
        removeFrames();
    }

    Params getParams() const CV_OVERRIDE { return params; }

    void clear() CV_OVERRIDE
    {
        removeFrames();
        clearGyro();
        hasOrigin = false;
    }

    bool addFrame(InputArray image, double seconds, const MotionPrior& prior) CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        checkImage(image, "image", given.imageSize);
        seconds = sinceOrigin(seconds, prior);
        finder.find(image, params.estimator.detector, params.estimator.minLength, found);
        const GrayFrame frame(finder.reduced(), finder.reduction(), seconds);
        const bool isAdded = add(segmentRows(found), seconds, prior, [&](double passed) {
            const FrameFeatures::Link link = features.track(start, frame, passed, predictPoints(start, gates, filter));
            if (link == FrameFeatures::BRIDGED) // the interval is that to the frame before
                features.leaveOut(passed);
        });
        finder.release();
        return isAdded;
    }

    bool addPoints(InputArray points, InputArray segments, double seconds, const MotionPrior& prior) CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        seconds = sinceOrigin(seconds, prior);
        const Mat rows = segmentRows(points, "points"), segmentsOfFrame = segmentRows(segments);
        std::vector<PointPair> pairs;
        for (int i = 0; i < rows.rows; i++)
        {
            const double* p = rows.ptr<double>(i);
            const PointPair pair = {Point2d(p[0], p[1]), Point2d(p[2], p[3])};
            if (isInImage(pair.other) && isInImage(pair.now))
                pairs.push_back(pair);
        }
        return add(segmentsOfFrame, seconds, prior, [&](double passed) { features.setPoints(start, pairs, passed); });
    }

    void addGyro(InputArray times, InputArray rates) CV_OVERRIDE
    {
        const Mat seconds = matrixOf(times, "times");
        const bool begins = !hasOrigin && seconds.type() == CV_64F && !seconds.empty();
        const double first = begins ? seconds.at<double>(0) : origin;
        gyro.add(seconds, matrixOf(rates, "rates"), first);
        if (begins) // nothing was wrong with them
            setOrigin(first);
    }

    void clearGyro() CV_OVERRIDE { gyro.clear(); }

    MountCalibration calibrate() const CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        const MountVector before = sigmaBefore();
        MountVector prior = before;
        DriveFit best(before);
        double longer = 1, focalSigma = start.focalSigma / start.cameraMatrix(0, 0);
        if (frames.size() > size_t(LEAST_WAVES))
        {
            best = fitDrive(longer, prior);
            if (focalSigma > 0 && best.gyro.frames > 0)
            {
                takeFocalOf(best.gyro, longer, focalSigma);
                best = fitDrive(longer, prior);
            }
            if (given.lineDelay > 0 && !isLineDelayObserved(best.mount, before))
                takeGivenDelay(longer, prior, best.mount);
            if (focalSigma > 0)
                addDifference(fitDrive(longer * (1 + focalSigma), prior).mount, best.mount);
        }
        return report(best, before, longer, focalSigma);
    }

    String getDefaultName() const CV_OVERRIDE { return "rsackermann_MountCalibrator"; }

private:
    void removeFrames()
    {
        start = given;
        start.rollSigma = start.pitchSigma = 0; // params.tiltSigma is what isn't known of its tilt
        frames.clear();
        numbers.clear();
        features.reset();
        number = 0;
        drive = 0;
        contraryFrames = contradictedFrames = 0;
        clock = wholeDrive();
        stride = 1;
        filter.hasFrame = false;
        givenBefore = MotionPrior();
    }

    // Times are differentiated by: of a clock that began long ago not enough digits would be left.
    void setOrigin(double seconds)
    {
        if (!hasOrigin && std::abs(seconds) <= LARGEST_VALUE)
        {
            origin = seconds;
            hasOrigin = true;
        }
    }

    double sinceOrigin(double seconds, const MotionPrior& prior)
    {
        checkFinite(seconds, "seconds");
        prior.check();
        setOrigin(seconds);
        return seconds - origin;
    }

    bool isInImage(const Point2d& p) const
    {
        return p.x >= -0.5 && p.y >= -0.5 && p.x <= given.imageSize.width - 0.5 && p.y <= given.imageSize.height - 0.5;
    }

    MountVector sigmaBefore() const
    {
        const double delaySigma = relativeLineDelaySigma(given),
                     delay = delaySigma > 0 ? delaySigma : params.lineDelaySigma * (given.lineDelay > 0 ? 1 : 2);
        MountVector sigma;
        sigma << params.tiltSigma, params.tiltSigma, params.headingSigma, LEVER_SIGMA, delay, delay;
        return sigma;
    }

    struct DriveFit
    {
        MountFit mount;
        GyroOfDrive gyro;

        //! What is known before.
        explicit DriveFit(const MountVector& before)
            : mount{MountVector::Zero(), before, before[MOUNT_DELAY], before[MOUNT_DELAY]}
        {
        }
    };

    // Of steps that follow each other like those of a geometric series.
    static double wayLeft(double before, double step)
    {
        const double mostRatio = 0.9, ratio = std::abs(step) < mostRatio * std::abs(before) ? step / before : 0;
        return step * ratio / (1 - ratio);
    }

    //! @param longer the focal length over that of the camera.
    DriveFit fitDrive(double longer, const MountVector& before) const
    {
        RollingShutterCamera camera = start;
        camera.cameraMatrix(0, 0) *= longer;
        camera.cameraMatrix(1, 1) *= longer;
        std::vector<CalibrationFrame> fitted = frames;
        for (CalibrationFrame& frame : fitted)
            frame.seeThroughOtherFocal(camera.uprightRotation, longer);
        const Suspension suspension = {params.suspensionSigma, params.suspensionTime};
        DriveFit fit(before);
        std::list<GyroSamples> curves;
        MountVector prior = before;
        // The first pass finds how frames turn, whatever their rows do, the second one the line delay for the third.
        // With a gyro the first three show where its clock is bound for (doc/theory.md, "Self-calibration").
        const int passes = gyro.empty() ? 3 : 4;
        double delays[4];
        for (int pass = 0; pass < passes; pass++)
        {
            const double delayRatio = std::exp(fit.mount.value[MOUNT_DELAY]);
            if (pass > 0)
                curves = turnRowsByNeighbours(camera, delayRatio, fitted);
            fit.gyro = alignGyro(gyro, camera, delayRatio, fitted);
            delays[pass] = fit.gyro.alignment.delay;
            if (pass == 3)
            {
                const double left = wayLeft(delays[2] - delays[1], delays[3] - delays[2]);
                fit.gyro.alignment.delay += left;
                for (CalibrationFrame& frame : fitted)
                    if (frame.rowTurns.showDelay())
                        frame.rowTurns.delayBy(left);
            }
            fit.mount = fitMount(camera, fitted, prior, suspension);
            // The weights are cautious: where frames scatter less than they say, what was known before is to count
            // less as well.
            prior[MOUNT_DELAY] = prior[MOUNT_PASSING] =
                before[MOUNT_DELAY] * std::max(1., fit.mount.weightsSigma / fit.mount.sigma[MOUNT_DELAY]);
        }
        fit.gyro.alignment.scale *= longer;
        fit.gyro.scaleSigma *= longer;
        return fit;
    }

    // Where the focal length isn't exact, it is what the gyro and the camera say. How points move shows it as well, but
    // errs by many of its standard deviations where rows turn in other ways than the curve through the frames.
    static void takeFocalOf(const GyroOfDrive& gyro, double& longer, double& focalSigma)
    {
        const double shown = std::hypot(gyro.scaleSigma, GyroSigmas().scale), sum = std::hypot(shown, focalSigma),
                     weight = focalSigma * focalSigma / (sum * sum);
        longer = 1 + weight * (gyro.alignment.scale - 1);
        focalSigma = shown * focalSigma / sum / longer;
    }

    // If the drive doesn't show the line delay, the given one is kept, and the mount's angles are those that go with
    // it.
    void takeGivenDelay(double longer, MountVector& prior, MountFit& fit) const
    {
        prior[MOUNT_DELAY] = prior[MOUNT_PASSING] = FLT_EPSILON;
        const MountFit held = fitDrive(longer, prior).mount;
        addDifference(held, fit);
        fit.value = held.value;
    }

    static void addDifference(const MountFit& other, MountFit& fit)
    {
        for (int i = 0; i < MOUNT_VALUES; i++)
            fit.sigma[i] = std::hypot(fit.sigma[i], other.value[i] - fit.value[i]);
        fit.turningSigma = std::hypot(fit.turningSigma, other.value[MOUNT_DELAY] - fit.value[MOUNT_DELAY]);
    }

    //! @param setPoints sets the points of the frame, by the seconds since the one before.
    template <class SetPoints>
    bool add(const Mat& segments, double seconds, const MotionPrior& ofInstant, const SetPoints& setPoints)
    {
        const double before = filter.time, passed = seconds - before;
        const MotionPrior prior = meanOf(givenBefore, ofInstant);
        givenBefore = ofInstant;
        // Frames that go back in time are those of another drive.
        if (!(passed > 0))
            filter.hasFrame = false;
        const bool follows = filter.advance(seconds, start, gates);
        unaided.hasFrame = follows;
        unaided.advance(seconds, start, gates);
        if (!follows)
        {
            features.reset();
            drive++;
        }
        else if (!(start.lineDelay > 0))
        {
            start.lineDelay = passed / start.imageSize.height / 2; // rows take between nothing and all of the time
            filter.reset(start, gates);
            unaided.reset(start, gates);
        }
        setPoints(passed);
        if (!follows || features.bearings.size() < LEAST_POINTS)
        {
            clock.interrupt();
            return false;
        }
        selectCandidates(segments, start, gates, features.verticals, features.others);
        SequenceFit fit(filter.state);
        MotionPrior rest = prior;
        rest.speedSigma = rest.yawRateSigma = 0;
        bool moves = moved(unaided, rest, fit);
        contraryFrames += moves && goesTheOtherWay(fit, prior);
        contradictedFrames += moves && contradictsGiven(fit, prior);
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

    // Points show means between two frames, and what is given is of instants.
    static MotionPrior meanOf(const MotionPrior& first, const MotionPrior& second)
    {
        MotionPrior mean = second;
        average(first.yawRate, first.yawRateSigma, mean.yawRate, mean.yawRateSigma);
        average(first.speed, first.speedSigma, mean.speed, mean.speedSigma);
        return mean;
    }

    static void average(double other, double otherSigma, double& value, double& sigma)
    {
        if (!(sigma > 0 && otherSigma > 0))
            return;
        value = (value + other) / 2;
        sigma = (sigma + otherSigma) / 2; // as of a sensor that errs in both alike
    }

    // Whether the points of a frame show a motion.
    bool moved(SequenceFilter& of, const MotionPrior& prior, SequenceFit& fit) const
    {
        of.state.measure(prior);
        return of.update(features, start, gates, fit) && fit.moves;
    }

    static ClockNoise wholeDrive() { return ClockNoise(std::numeric_limits<double>::infinity()); }

    // Than given, or than cars usually go.
    bool goesTheOtherWay(const SequenceFit& fit, const MotionPrior& prior) const
    {
        MotionPrior forward;
        forward.speed = 1;
        forward.speedSigma = FLT_EPSILON;
        AckermannMotion seen;
        fit.state.toMotion(start.secondsPerUnitTime(), seen);
        return showsOtherDirection(seen, prior.speedSigma > 0 ? prior : forward);
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

    CalibrationFrame frameOf(const SequenceFit& fit, double before, const MotionPrior& prior) const
    {
        CalibrationFrame frame;
        frame.drive = drive;
        frame.time = filter.time;
        frame.before = before;
        frame.interval = frame.time - before;
        frame.turn = TurnOfPoints(start, features.bearings, fit.values, filter.time, -frame.interval);
        frame.verticals = features.verticals;
        for (int i = 0; i < FRAME_VALUES; i++)
            frame.value[i] = i < SEQUENCE_VALUES ? fit.state.value[i] : 0;
        frame.bearings = withoutOwnCar(start, features.bearings, fit.values);
        SequenceState expected(start, gates);
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
    void keep(const CalibrationFrame& frame)
    {
        const int run = number++ / int(std::sqrt(params.maxFrames));
        if (run % stride)
            return;
        frames.push_back(frame);
        numbers.push_back(run);
        while (frames.size() > size_t(params.maxFrames))
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

    //! @param focalSigma relative.
    MountCalibration report(const DriveFit& best, const MountVector& before, double longer, double focalSigma) const
    {
        const MountFit& fit = best.mount;
        MountCalibration c;
        c.frames = int(frames.size());
        c.contraryFrames = contraryFrames;
        c.contradictedFrames = contradictedFrames;
        c.intervalSigma = clock.sigma();
        c.camera = given;
        MountVector sigma = fit.sigma;
        // Where images are left out most of the times between err alike.
        sigma[MOUNT_DELAY] = std::hypot(sigma[MOUNT_DELAY], c.intervalSigma);
        c.rollObserved = isObserved(sigma, before, MOUNT_ROLL);
        c.pitchObserved = isObserved(sigma, before, MOUNT_PITCH);
        c.headingObserved = isObserved(sigma, before, MOUNT_HEADING);
        c.lineDelayObserved = isLineDelayObserved(fit, before);
        // The azimuths are those of the upright frame, in which the optical axis may have moved.
        const Matx33d upright = tiltRotation(fit.value[MOUNT_ROLL], fit.value[MOUNT_PITCH]) * given.uprightRotation;
        c.camera.setGravity(Vec3d(upright(1, 0), upright(1, 1), upright(1, 2)));
        c.camera.heading = c.heading =
            given.heading + fit.value[MOUNT_HEADING] - std::atan2(upright(0, 2), upright(2, 2));
        if (c.lineDelayObserved)
            c.camera.lineDelay = start.lineDelay * std::exp(fit.value[MOUNT_DELAY]);
        c.lineDelay = c.camera.lineDelay;
        rollAndPitchOf(c.camera.gravity(), c.roll, c.pitch);
        c.rollSigma = sigma[MOUNT_ROLL];
        c.pitchSigma = sigma[MOUNT_PITCH];
        c.camera.rollSigma = c.rollSigma;
        c.camera.pitchSigma = c.pitchSigma;
        c.camera.headingSigma = c.headingSigma = sigma[MOUNT_HEADING];
        c.lineDelaySigma = (c.lineDelayObserved ? sigma : before)[MOUNT_DELAY] * c.lineDelay;
        if (c.lineDelayObserved)
            c.camera.lineDelaySigma = c.lineDelaySigma;
        c.camera.cameraMatrix(0, 0) *= longer;
        c.camera.cameraMatrix(1, 1) *= longer;
        c.camera.focalSigma = focalSigma * c.camera.cameraMatrix(0, 0);
        c.gyroFrames = best.gyro.frames;
        c.gyroDelay = best.gyro.alignment.delay;
        c.gyroDelaySigma = best.gyro.delaySigma;
        c.focalScale = best.gyro.alignment.scale;
        c.focalScaleSigma = best.gyro.scaleSigma;
        return c;
    }

    bool isLineDelayObserved(const MountFit& fit, const MountVector& before) const
    {
        return std::max(std::hypot(fit.sigma[MOUNT_DELAY], clock.sigma()), fit.turningSigma) <
               OBSERVED * before[MOUNT_DELAY];
    }

    static bool isObserved(const MountVector& sigma, const MountVector& before, MountValue which)
    {
        return sigma[which] < OBSERVED * before[which];
    }

    RollingShutterCamera given, start; // start: with a line delay
    Params params;
    AckermannEstimator::Params gates; // of segments and of the fit of a frame
    SegmentFinder finder{true};
    FrameFeatures features;
    Mat found;

    double origin = 0; // of the times, seconds: the first one
    bool hasOrigin = false;
    GyroSamples gyro;
    std::vector<CalibrationFrame> frames;
    std::vector<int> numbers; // of each frame's run
    int number, drive, stride, contraryFrames, contradictedFrames;
    MotionPrior givenBefore; // of the frame before

    SequenceFilter filter, unaided; // unaided: without a given speed or yaw rate
    ClockNoise clock = wholeDrive();
};

} // namespace

Ptr<MountCalibrator> MountCalibrator::create(const RollingShutterCamera& camera, const Params& params)
{
    CV_INSTRUMENT_REGION();
    return makePtr<MountCalibratorImpl>(camera, params);
}

Ptr<MountCalibrator> MountCalibrator::load(const String& filename, const String& objname)
{
    return StoredAlgorithm<MountCalibrator>::load(filename, objname);
}

}} // namespace cv::rsackermann
