// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

// Finds how a camera is mounted, and its line delay, from the frames of a drive.

#include "calibrate/drive_reader.hpp"
#include "camera_file.hpp"
#include "estimator_options.hpp"
#include "files.hpp"
#include "gyro_file.hpp"
#include "log_use.hpp"
#include "output/interrupt.hpp"
#include "output/output_plan.hpp"
#include "output/result_names.hpp"
#include "progress.hpp"
#include "repeated_images.hpp"
#include "units.hpp"

#include "opencv2/rsackermann.hpp"
#include <cstdio>
#include <iostream>

namespace {

using namespace rsackermann_samples;
using cv::rsackermann::MountCalibration;
using cv::rsackermann::MountCalibrator;

const char* const ABOUT =
    "Self-calibrates the mounting angles and the line delay of a car's camera from the frames of a drive.\n"
    "usage: rsackermann_calibrate [--option=value]... [--] INPUT...\n"
    "INPUT is an image, a video, a folder of images, a printf pattern of image names or @FILE with one name per line,\n"
    "in the order of the drive. Writes a camera file for rsackermann_correct --camera, with roll, pitch, heading and\n"
    "line_delay and a standard deviation of each.\n"
    "Exit code: 0 done, 1 inputs failed or no car moves in them, 2 the command line isn't understood, 130 or 143\n"
    "interrupted.\n";

const char* const KEYS =
    "{help       |        | print this message}"
    "{output     |        | camera file to be written}"
    "{overwrite  |        | replace an existing file}"
    "{log        |        | CSV file with values for each frame, as for rsackermann_correct; its times, speeds and yaw "
    "rates are used}"
    "{threads    |        | maximum number of threads}";

// Of a focal length that is no calibration, from a data sheet or a field of view.
const double APPROXIMATE_FOCAL = 0.05;

struct Task
{
    InputList inputs;
    CameraSettings camera;
    MountCalibrator::Params params;
    DriveLog log;
    GyroRecording gyro;
    std::string output;
};

Task readTask(const Options& options)
{
    Task task;
    if (options.arguments().empty())
        throw UsageError("there is no input");
    if (!options.given("camera") && !options.given("focal"))
        throw UsageError("--camera is missing; without a calibration --focal takes its place");
    if (!options.given("output"))
        throw UsageError("--output is missing");
    task.camera = readCameraOptions(options);
    task.camera.needsReadOut = false; // it is measured
    if (!task.camera.calibrated && !(task.camera.focalSigma > 0))
        task.camera.focalSigma = APPROXIMATE_FOCAL * task.camera.focal;
    if (task.camera.scan == cv::rsackermann::SCAN_LEFT_TO_RIGHT ||
        task.camera.scan == cv::rsackermann::SCAN_RIGHT_TO_LEFT)
        throw UsageError("the lines of the sensor are columns of the image (scan): no vertical shows the motion");
    task.output = options.outputFile("output");
    task.params.estimator.detector = readDetector(options);
    task.inputs = listInputs(options.arguments());
    for (const std::string& warning : task.inputs.warnings)
        std::cerr << "rsackermann_calibrate: " << warning << std::endl;
    if (options.given("log"))
    {
        task.log = DriveLog(options.inputFile("log"));
        checkLog(task.log, task.inputs, "rsackermann_calibrate");
    }
    task.gyro = readGyroOptions(options, "rsackermann_calibrate");
    checkGyro(task.gyro, task.log, task.inputs);
#ifndef RSACKERMANN_WITH_VIDEOIO
    for (const Input& input : task.inputs.inputs)
        if (isVideo(input.name))
            throw UsageError("videos are not read, since OpenCV's module videoio was missing when this program was "
                             "built: " +
                             input.name);
#endif
    OutputPlan plan;
    plan.addInputs(options.inputFiles());
    plan.addInputs(filesOf(task.inputs));
    plan.addOutput(task.output, "the calibration");
    setThreads(options);
    checkResult(task.output, options.flag("overwrite"));
    if (!isStorageFormat(extension(task.output)))
        throw UsageError("option --output: the extension of " + task.output +
                         " is none of .yml, .yaml, .xml and .json");
    plan.removeLeftovers();
    return task;
}

// Values that are observable go into the settings, the others stay.
CameraSettings settingsOf(const MountCalibration& c, CameraSettings s)
{
    s.size = c.camera.imageSize;
    s.K = c.camera.cameraMatrix;
    s.focalSigma = c.camera.focalSigma;
    const auto set = [](bool isObserved, double found, double sigma, double& value, double& sigmaOfValue) {
        if (!isObserved)
            return;
        value = found / DEGREE;
        sigmaOfValue = sigma / DEGREE;
    };
    set(c.rollObserved, c.roll, c.rollSigma, s.roll, s.rollSigma);
    set(c.pitchObserved, c.pitch, c.pitchSigma, s.pitch, s.pitchSigma);
    s.rollIsGiven |= c.rollObserved;
    s.pitchIsGiven |= c.pitchObserved;
    s.headingIsGiven |= c.headingObserved;
    set(c.headingObserved, c.heading, c.headingSigma, s.heading, s.headingSigma);
    if (c.lineDelayObserved)
    {
        s.readOut = 0;
        s.lineDelay = c.lineDelay;
        s.lineDelaySigma = c.lineDelaySigma;
    }
    return s;
}

void print(const char* name, bool isObserved, double value, double sigma, const char* unit, const char* missing)
{
    if (isObserved)
        std::printf("%-11s %11.4g +- %.2g %s\n", name, value, sigma, unit);
    else
        std::printf("%-11s not observable: %s\n", name, missing);
}

//! @param focal of the camera that is given.
void print(const MountCalibration& c, double focal, int frames)
{
    std::printf("frames      %d of %d\n", c.frames, frames);
    const char* few = "too few frames, points or verticals, or too little motion";
    print("roll", c.rollObserved, c.roll / DEGREE, c.rollSigma / DEGREE, "deg", few);
    print("pitch", c.pitchObserved, c.pitch / DEGREE, c.pitchSigma / DEGREE, "deg", few);
    print("heading", c.headingObserved, c.heading / DEGREE, c.headingSigma / DEGREE, "deg", few);
    const std::string why = c.gyroFrames > 0
                                ? "the drive shakes and bends too little"
                                : "the drive has too few frames, or too few bends with verticals in sight and no gyro "
                                  "(--gyro) that shows shaking";
    print(
        "line delay", c.lineDelayObserved, c.lineDelay * 1e6, c.lineDelaySigma * 1e6, "us",
        (why + ", or its lines are read in another order (--scan), and then roll and pitch aren't those of the camera")
            .c_str());
    if (c.gyroFrames > 0)
    {
        std::printf("gyro        used in %d frames\n", c.gyroFrames);
        print("gyro delay", true, c.gyroDelay * 1e3, c.gyroDelaySigma * 1e3, "ms", "");
        print("gyro focal", true, c.focalScale * focal, c.focalScaleSigma * focal, "px", "");
    }
    const cv::Vec3d h = c.horizon();
    std::printf("horizon     %.5f x %+.5f y %+.2f = 0 in pixels without lens distortion\n", h[0], h[1], h[2]);
}

cv::Ptr<MountCalibrator> calibratorOf(const Task& task, const cv::Size& size)
{
    const cv::rsackermann::RollingShutterCamera camera = task.camera.makeCamera(size);
    const double focal = camera.cameraMatrix(0, 0);
    if (camera.focalSigma > focal / 2) // to which what other focal lengths change isn't in proportion
        throw UsageError(cv::format("--focal_sigma is %g px; up to half of the focal length, %g px, is expected",
                                    camera.focalSigma, focal / 2));
    try
    {
        return MountCalibrator::create(camera, task.params);
    }
    catch (const cv::Exception& e)
    {
        throw UsageError(e.err);
    }
}

int run(const Options& options)
{
    listenForInterrupts();
    const Task task = readTask(options);
    cv::Ptr<MountCalibrator> calibrator;
    Progress progress;
    int frames = 0, failures = 0, untimed = 0;
    bool isLogUsed = false, isSpeedGiven = false;
    ImageChange change;
    std::vector<double> changes;
    const auto fail = [&](const std::string& input, const std::string& message) {
        failures++;
        progress.clear();
        std::cerr << "rsackermann_calibrate: " << input << ": " << message << std::endl;
    };
    const auto use = [&](const DriveFrame& frame, double done) {
        if (!calibrator)
        {
            calibrator = calibratorOf(task, frame.image.size());
            calibrator->addGyro(task.gyro.times, task.gyro.rates);
        }
        calibrator->addFrame(frame.image, frame.facts.time, priorOf(frame.facts));
        changes.push_back(change.to(frame.image));
        frames++;
        untimed += !frame.isTimeGiven;
        isLogUsed |= frame.facts.isLogged;
        isSpeedGiven |= priorOf(frame.facts).speedSigma > 0;
        progress.update(done, 1, task.output);
    };
    try
    {
        readDrive(task.inputs, task.log, use, fail);
    }
    catch (const Interrupted&)
    {
        return 128 + interruptSignal();
    }
    if (!calibrator)
        throw InputError("no frame can be read");
    if (!task.log.empty() && !isLogUsed)
    {
        progress.clear();
        std::cerr << "rsackermann_calibrate: " << task.log.whyUseless() << std::endl;
    }
    if (untimed > 1)
    {
        progress.clear();
        std::cerr << "rsackermann_calibrate: " << NO_TIMES << std::endl;
    }
    const MountCalibration calibration = calibrator->calibrate();
    progress.clear();
    const std::string repeated = repeatedImages(changes);
    if (!repeated.empty())
        std::cerr << "rsackermann_calibrate: " << repeated << std::endl;
    const double jitters = 0.06; // steady clocks look like 0.045 at most, in stop and go, images left out like 0.1
    if (calibration.intervalSigma > jitters)
        std::cerr << cv::format(
                         "rsackermann_calibrate: speeds go to and fro as if the times between images erred by %.0f %%: "
                         "converters of frame rates leave images out or add some; give the images as the camera took "
                         "them, or their times (--log)",
                         100 * calibration.intervalSigma)
                  << std::endl;
    if (2 * calibration.contraryFrames > calibration.frames)
    {
        const std::string words = cv::format(
            "in %d of %d frames the car drives %s: unless it does, the camera looks to the other end of the car "
            "(--heading=180 for one that looks back)",
            calibration.contraryFrames, frames, isSpeedGiven ? "against the speed of the log" : "backward");
        if (isSpeedGiven) // what was found is a compromise
            throw InputError(words);
        std::cerr << "rsackermann_calibrate: " << words << std::endl;
    }
    // A heading that is found elsewhere makes up for it.
    const bool isTurned =
        calibration.headingObserved &&
        std::abs(calibration.heading - calibrator->getCamera().heading) > 3 * calibration.headingSigma;
    if (2 * calibration.contradictedFrames > frames && !isTurned)
        std::cerr << cv::format("rsackermann_calibrate: in %d of %d frames the images contradict the yaw rate or speed "
                                "of the log: its signs, units or times may be others",
                                calibration.contradictedFrames, frames)
                  << std::endl;
    if (calibration.frames == 0)
        throw InputError("no frame shows a car that moves: consecutive frames are needed, at their times");
    print(calibration, calibrator->getCamera().cameraMatrix(0, 0), frames);
    if (!task.gyro.times.empty() && calibration.gyroFrames == 0)
        std::cerr
            << "rsackermann_calibrate: the images contradict the gyro, which isn't used: its unit, axes or clock may "
               "be another, or it doesn't cover the drive\n";
    if (!calibration.rollObserved && !calibration.pitchObserved && !calibration.headingObserved &&
        !calibration.lineDelayObserved && calibration.gyroFrames == 0)
        throw InputError("nothing is observable, so that no file is written");
    writeCameraFile(task.output, settingsOf(calibration, task.camera.forSize(calibration.camera.imageSize)));
    return failures ? 1 : 0;
}

} // namespace

int main(int argc, const char** argv)
{
    return runProgram(ABOUT, std::string(KEYS) + GYRO_KEYS + DETECTOR_KEY + CAMERA_KEYS, run, argc, argv);
}
