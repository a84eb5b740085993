// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "../precomp.hpp"
#include "drive_fit.hpp"

namespace cv { namespace rsackermann {

// Of the standard deviation before, at most, for a value that is observable
static const double OBSERVED = 0.5;

bool isObserved(const MountVector& sigma, const MountVector& before, MountValue which)
{
    return sigma[which] < OBSERVED * before[which];
}

bool isLineDelayObserved(const MountFit& fit, const MountVector& before, double intervalSigma)
{
    return std::max(std::hypot(fit.sigma[MOUNT_DELAY], intervalSigma), fit.turningSigma) <
           OBSERVED * before[MOUNT_DELAY];
}

// Of steps that follow each other like those of a geometric series.
static double wayLeft(double before, double step)
{
    const double mostRatio = 0.9, ratio = std::abs(step) < mostRatio * std::abs(before) ? step / before : 0;
    return step * ratio / (1 - ratio);
}

static void addDifference(const MountFit& other, MountFit& fit)
{
    for (int i = 0; i < MOUNT_VALUES; i++)
        fit.sigma[i] = std::hypot(fit.sigma[i], other.value[i] - fit.value[i]);
    fit.turningSigma = std::hypot(fit.turningSigma, other.value[MOUNT_DELAY] - fit.value[MOUNT_DELAY]);
}

static DriveFit asBefore(const MountVector& before)
{
    return {{MountVector::Zero(), before, before[MOUNT_DELAY], before[MOUNT_DELAY]}, GyroOfDrive(), 1, 0, 1, 0};
}

static DriveFit fitWithFocal(const Drive& drive, double focalRatio, const MountVector& before)
{
    RollingShutterCamera camera = drive.camera;
    camera.cameraMatrix(0, 0) *= focalRatio;
    camera.cameraMatrix(1, 1) *= focalRatio;
    std::vector<CalibrationFrame> fitted = drive.frames;
    for (CalibrationFrame& frame : fitted)
        frame.seeThroughOtherFocal(camera.uprightRotation, focalRatio);
    DriveFit fit = asBefore(before);
    fit.focalRatio = focalRatio;
    std::list<GyroSamples> curves;
    MountVector prior = before;
    // The first pass finds how frames turn, whatever their rows do, the second one the line delay for the third.
    // With a gyro the last three show where its clock is bound for (doc/theory.md, "Self-calibration").
    const int passes = drive.gyro.empty() ? 3 : 4;
    double delays[4];
    for (int pass = 0; pass < passes; pass++)
    {
        const double delayRatio = std::exp(fit.mount.value[MOUNT_DELAY]);
        if (pass > 0)
        {
            curves = turnRowsByNeighbours(camera, delayRatio, fitted);
            fit.gyro = alignGyro(drive.gyro, camera, delayRatio, fitted);
            delays[pass] = fit.gyro.alignment.delay;
        }
        if (pass == 3)
        {
            const double left = wayLeft(delays[2] - delays[1], delays[3] - delays[2]);
            fit.gyro.alignment.delay += left;
            for (CalibrationFrame& frame : fitted)
                if (frame.rowTurns.showDelay())
                    frame.rowTurns.delayBy(left);
        }
        fit.mount = fitMount(camera, fitted, prior, drive.suspension);
        // The weights are cautious: where frames scatter less than they say, what was known before is to count
        // less as well.
        prior[MOUNT_DELAY] = prior[MOUNT_PASSING] =
            before[MOUNT_DELAY] * std::max(1., fit.mount.weightsSigma / fit.mount.sigma[MOUNT_DELAY]);
    }
    return fit;
}

// Whether the gyro turns as many frames.
static bool isComparable(const DriveFit& fit, const DriveFit& other)
{
    return other.gyro.frames >= fit.gyro.frames;
}

// With a focal length to which the gyro may as well belong: shorter or longer, by where the camera looks.
static DriveFit fitWithOtherFocal(const Drive& drive, const DriveFit& fit, const MountVector& before)
{
    const double scale = std::log(fit.gyro.alignment.scale),
                 step = std::copysign(std::max(std::abs(scale), GyroSigmas().scale), scale);
    const DriveFit ahead = fitWithFocal(drive, fit.focalRatio * std::exp(step), before);
    return isComparable(fit, ahead) ? ahead : fitWithFocal(drive, fit.focalRatio * std::exp(-step), before);
}

// The focal length over that of a fit, and its standard deviation, if the gyro's scale errs by so much, relative.
// By how the scale changes with the focal length: turns of cameras that look ahead seem the smaller the longer it is,
// those of cameras that look aside may seem larger.
static Vec2d focalByGyro(const DriveFit& fit, const DriveFit& other, double scaleSigma, double sigmaBefore)
{
    const double ahead = -1, scale = std::log(fit.gyro.alignment.scale),
                 change = std::log(other.gyro.alignment.scale) - scale,
                 slope = isComparable(fit, other) ? change / std::log(other.focalRatio / fit.focalRatio) : ahead,
                 shown = std::hypot(fit.gyro.scaleSigma / fit.gyro.alignment.scale, scaleSigma),
                 sum = std::hypot(slope * sigmaBefore, shown),
                 ratio = std::exp(-slope * std::pow(sigmaBefore / sum, 2) * scale);
    return Vec2d(ratio, ratio * sigmaBefore * shown / sum);
}

DriveFit fitDrive(const Drive& drive, const MountVector& before)
{
    MountVector prior = before;
    DriveFit best = asBefore(before);
    Vec2d shown(1, 0); // the focal length, by the gyro
    double focalRatio = 1, focalSigma = drive.camera.focalSigma / drive.camera.cameraMatrix(0, 0);
    if (drive.frames.size() > size_t(LEAST_WAVES))
    {
        best = fitWithFocal(drive, focalRatio, prior);
        if (best.gyro.frames > 0)
        {
            const double ofGyro = GyroSigmas().scale, unknown = 1;
            const DriveFit other = fitWithOtherFocal(drive, best, prior);
            shown = focalByGyro(best, other, 0, unknown);
            // Where the focal length isn't exact, it is what the gyro and the camera say. How points move shows it as
            // well, but errs by many of its standard deviations where rows turn in other ways than the curve through
            // the frames.
            if (focalSigma > 0)
            {
                const Vec2d found = focalByGyro(best, other, ofGyro, focalSigma);
                focalRatio = found[0];
                focalSigma = found[1] / focalRatio;
                best = fitWithFocal(drive, focalRatio, prior);
            }
        }
        // If the drive doesn't show the line delay, the given one is kept, and the mount's angles are those that go
        // with it.
        if (drive.lineDelayIsGiven && !isLineDelayObserved(best.mount, before, drive.intervalSigma))
        {
            prior[MOUNT_DELAY] = prior[MOUNT_PASSING] = FLT_EPSILON;
            const MountFit held = fitWithFocal(drive, focalRatio, prior).mount;
            addDifference(held, best.mount);
            best.mount.value = held.value;
        }
        if (focalSigma > 0)
            addDifference(fitWithFocal(drive, focalRatio * (1 + focalSigma), prior).mount, best.mount);
    }
    best.focalSigma = focalSigma;
    best.focalByGyro = shown[0];
    best.focalByGyroSigma = shown[1];
    return best;
}

}} // namespace cv::rsackermann
