// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "opencv2/rsackermann/calibration.hpp"
#include "../camera/axis_rotations.hpp"
#include "../camera/line_delay_sigma.hpp"
#include "../checks.hpp"
#include "../features/segment_finder.hpp"
#include "../storage.hpp"
#include "drive_fit.hpp"
#include "drive_frames.hpp"

namespace cv { namespace rsackermann {

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
        : params(params_), frames(camera, params_.estimator, params_.maxFrames)
    {
        params.check();
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
        const bool isAdded =
            frames.add(GrayFrame(finder.reduced(), finder.reduction(), seconds), segmentRows(found), prior);
        finder.release();
        return isAdded;
    }

    bool addPoints(InputArray points, InputArray segments, double seconds, const MotionPrior& prior) CV_OVERRIDE
    {
        CV_INSTRUMENT_REGION();
        seconds = sinceOrigin(seconds, prior);
        return frames.add(segmentRows(points, "points"), segmentRows(segments), seconds, prior);
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
        const Drive drive = {frames.camera(),
                             given.lineDelay > 0,
                             frames.kept(),
                             gyro,
                             {params.suspensionSigma, params.suspensionTime},
                             frames.intervalSigma()};
        return report(fitDrive(drive, before), before);
    }

    String getDefaultName() const CV_OVERRIDE { return "rsackermann_MountCalibrator"; }

private:
    void removeFrames()
    {
        AckermannEstimator::Params gates = params.estimator;
        gates.gravitySigma = gates.vehiclePitchSigma = params.tiltSigma;
        frames = DriveFrames(given, gates, params.maxFrames);
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

    MountVector sigmaBefore() const
    {
        const double delaySigma = relativeLineDelaySigma(given),
                     delay = delaySigma > 0 ? delaySigma : params.lineDelaySigma * (given.lineDelay > 0 ? 1 : 2);
        MountVector sigma;
        sigma << params.tiltSigma, params.tiltSigma, params.headingSigma, LEVER_SIGMA, delay, delay;
        return sigma;
    }

    MountCalibration report(const DriveFit& best, const MountVector& before) const
    {
        const MountFit& fit = best.mount;
        MountCalibration c;
        c.frames = int(frames.kept().size());
        c.contraryFrames = frames.contrary;
        c.contradictedFrames = frames.contradicted;
        c.intervalSigma = frames.intervalSigma();
        c.camera = given;
        MountVector sigma = fit.sigma;
        // Where images are left out most of the times between err alike.
        sigma[MOUNT_DELAY] = std::hypot(sigma[MOUNT_DELAY], c.intervalSigma);
        c.rollObserved = isObserved(sigma, before, MOUNT_ROLL);
        c.pitchObserved = isObserved(sigma, before, MOUNT_PITCH);
        c.headingObserved = isObserved(sigma, before, MOUNT_HEADING);
        c.lineDelayObserved = isLineDelayObserved(fit, before, c.intervalSigma);
        // The azimuths are those of the upright frame, in which the optical axis may have moved.
        const Matx33d upright = tiltRotation(fit.value[MOUNT_ROLL], fit.value[MOUNT_PITCH]) * given.uprightRotation;
        c.camera.setGravity(Vec3d(upright(1, 0), upright(1, 1), upright(1, 2)));
        c.camera.heading = c.heading =
            given.heading + fit.value[MOUNT_HEADING] - std::atan2(upright(0, 2), upright(2, 2));
        if (c.lineDelayObserved)
            c.camera.lineDelay = frames.camera().lineDelay * std::exp(fit.value[MOUNT_DELAY]);
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
        c.camera.cameraMatrix(0, 0) *= best.focalRatio;
        c.camera.cameraMatrix(1, 1) *= best.focalRatio;
        c.camera.focalSigma = best.focalSigma * c.camera.cameraMatrix(0, 0);
        c.gyroFrames = best.gyro.frames;
        c.gyroDelay = best.gyro.alignment.delay;
        c.gyroDelaySigma = best.gyro.delaySigma;
        c.focalScale = best.focalByGyro;
        c.focalScaleSigma = best.focalByGyroSigma;
        return c;
    }

    RollingShutterCamera given;
    Params params;
    SegmentFinder finder{true};
    Mat found;

    double origin = 0; // of the times, seconds: the first one
    bool hasOrigin = false;
    GyroSamples gyro;
    DriveFrames frames;
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
