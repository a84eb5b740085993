// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "camera_settings.hpp"
#include "camera_file.hpp"
#include "units.hpp"

#include "opencv2/rsackermann/estimator.hpp"

#include <algorithm>
#include <cmath>

namespace rsackermann_samples {

using namespace cv::rsackermann;

const std::vector<std::string> SCAN_WORDS = {"top_to_bottom", "bottom_to_top", "left_to_right", "right_to_left"};

const char* const CAMERA_KEYS =
    "{camera     |        | file with the camera's calibration: of OpenCV, ROS (camera_info) or Kalibr (camchain), or a "
    "lens profile of Gyroflow}"
    "{focal      |        | focal length in pixels, if there is no calibration (default 0.9 times the longer side, +- "
    "20 %)}"
    "{focal_sigma |       | standard deviation of the focal length in pixels}"
    "{line_delay |        | seconds between two lines; metric values, sensors and sequences need it}"
    "{readout    |        | seconds between the first and the last line's end, instead of --line_delay}"
    "{scan       |        | order of the lines: top_to_bottom (default), bottom_to_top, left_to_right or right_to_left}"
    "{reference  |        | line at whose instant the corrected image is taken: first, middle (default) or last to be "
    "read, or its number}"
    "{roll       |        | degrees, positive if the camera is turned clockwise seen from behind it}"
    "{pitch      |        | degrees, positive if the camera looks down}"
    "{heading    |        | degrees from the optical axis to the vehicle's forward direction, positive to the right}"
    "{height     |        | metres of the camera above the road}";

CameraSettings::CameraSettings()
    : calibrated(false), isScaled(false), K(cv::Matx33d::eye()), lensModel(LENS_PINHOLE), focal(0), lineDelay(0),
      readOut(0), scan(SCAN_TOP_TO_BOTTOM), reference("middle"), roll(0), pitch(0), heading(0), rollIsGiven(false),
      pitchIsGiven(false), headingIsGiven(false), height(0), rollSigma(0), pitchSigma(0), headingSigma(0),
      lineDelaySigma(0), focalSigma(0), needsReadOut(true)
{
}

std::string doubtOfReadOut(const RollingShutterCamera& camera, double interval)
{
    const double rounding = 1.05; // of intervals to milliseconds
    const double readOut =
        camera.lineDelay * (camera.isRowShutter() ? camera.imageSize.height : camera.imageSize.width);
    if (readOut <= rounding * interval)
        return "";
    return cv::format("the read-out of %.3g s is longer than the %.3g s between frames, but a sensor reads one frame "
                      "after the other: check --readout or --line_delay, and the times",
                      readOut, interval);
}

cv::Matx33d scaledIntrinsics(cv::Matx33d K, double widthFactor, double heightFactor)
{
    K(0, 0) *= widthFactor;
    K(1, 1) *= heightFactor;
    K(0, 2) = (K(0, 2) + 0.5) * widthFactor - 0.5;
    K(1, 2) = (K(1, 2) + 0.5) * heightFactor - 0.5;
    return K;
}

namespace {

bool haveSameShape(const cv::Size& a, const cv::Size& b)
{
    // Sizes are rounded to whole pixels, often even ones.
    return std::abs(double(a.width) * b.height / (double(a.height) * b.width) - 1) <= 0.02;
}

// A camera matrix of images of another size, where the file doesn't tell of which. Scaling moves the principal point
// along both sides of the image: that of images 1.5 times as large is a half (of each side a quarter) off the centre,
// of those 2/3 as large a third. To cut off a third of the height moves it by a quarter.
void checkPrincipalPoint(const cv::Matx33d& K, const cv::Size& imageSize)
{
    const double farthest = 0.3, x = (K(0, 2) + 0.5) / imageSize.width, y = (K(1, 2) + 0.5) / imageSize.height;
    if (std::abs(x - 0.5) + std::abs(y - 0.5) > farthest)
        throw InputError(cv::format(
            "the camera file has no image_width and image_height, and its principal point (%g, %g) is far from the "
            "centre of the image of %d x %d pixels: it seems to be for images of another size; if it isn't, add them",
            K(0, 2), K(1, 2), imageSize.width, imageSize.height));
}

// A focal length in millimetres, for instance. A lens that spreads all directions evenly over the shorter side has a
// focal length of that side / 2 pi; a pinhole camera, which keeps straight lines straight, would see 145 degrees.
void checkFocalLength(const RollingShutterCamera& camera)
{
    const cv::Size& size = camera.imageSize;
    const double least = std::min(size.width, size.height) / (2 * CV_PI),
                 focal = std::min(camera.cameraMatrix(0, 0), camera.cameraMatrix(1, 1));
    if (camera.lensModel == LENS_PINHOLE && focal < least)
        throw InputError(cv::format("the focal length of %g is too short for an image of %d x %d pixels: it is in "
                                    "pixels, %.0f at least if the lens is no fisheye",
                                    focal, size.width, size.height, std::ceil(least)));
}

// An image may be cut out of any place of the sensor, but the axis isn't a whole image beside it.
void checkAxis(const RollingShutterCamera& camera)
{
    const cv::Size& size = camera.imageSize;
    const double x = camera.cameraMatrix(0, 2), y = camera.cameraMatrix(1, 2);
    if (std::abs(x / size.width - 0.5) > 1.5 || std::abs(y / size.height - 0.5) > 1.5)
        throw InputError(cv::format("the principal point (%g, %g) of the camera matrix is far outside of the image, "
                                    "whose width and height are %d x %d pixels",
                                    x, y, size.width, size.height));
}

} // namespace

bool CameraSettings::hasLineDelay() const
{
    const auto isKnown = [](const CompatibleSetting& setting) { return setting.readOut > 0; };
    return lineDelay > 0 || readOut > 0 || std::any_of(compatible.begin(), compatible.end(), isKnown);
}

CameraSettings CameraSettings::with(const CompatibleSetting& setting) const
{
    CameraSettings own = *this;
    own.compatible.clear();
    own.size = setting.size;
    own.K = setting.K;
    own.lens = setting.lens;
    own.readOut = setting.readOut;
    own.scan = setting.scan;
    return own;
}

CameraSettings CameraSettings::forSize(const cv::Size& imageSize) const
{
    std::vector<CompatibleSetting> all(1, CompatibleSetting{size, K, lens, readOut, scan, ""});
    all.insert(all.end(), compatible.begin(), compatible.end());
    const auto isSame = [&](const CompatibleSetting& s) { return s.size == imageSize; };
    const auto isSimilar = [&](const CompatibleSetting& s) { return isScaled && haveSameShape(imageSize, s.size); };
    auto chosen = std::find_if(all.begin(), all.end(), isSame);
    if (chosen == all.end())
        chosen = std::find_if(all.begin(), all.end(), isSimilar);
    if (chosen == all.end())
        return with(all[0]);
    if (!chosen->refusal.empty())
        throw InputError(cv::format("the camera file can't be used for images of %d x %d pixels: %s", imageSize.width,
                                    imageSize.height, chosen->refusal.c_str()));
    CameraSettings own = with(*chosen);
    for (const CompatibleSetting& other : all)
    {
        if (other.size != chosen->size || !other.refusal.empty())
            continue;
        if (other.scan != chosen->scan)
            throw InputError(cv::format("the camera file has several directions of the read-out for images of %d x %d "
                                        "pixels: give --scan",
                                        imageSize.width, imageSize.height));
        if (other.readOut != chosen->readOut && needsReadOut)
            throw InputError(cv::format("the camera file has several read-out times for images of %d x %d pixels, %g "
                                        "and %g s, by the frame rate: give --readout",
                                        imageSize.width, imageSize.height, chosen->readOut, other.readOut));
        if (other.readOut != chosen->readOut)
            own.readOut = 0;
    }
    return own;
}

RollingShutterCamera CameraSettings::makeCamera(const cv::Size& imageSize) const
{
    if (!compatible.empty())
        return forSize(imageSize).makeCamera(imageSize);
    const double widthFactor = size.empty() ? 1 : double(imageSize.width) / size.width,
                 heightFactor = size.empty() ? 1 : double(imageSize.height) / size.height;
    if (isScaled ? !haveSameShape(imageSize, size) : !size.empty() && size != imageSize)
        throw InputError(cv::format("the image has %d x %d pixels, but the camera file is for %d x %d%s",
                                    imageSize.width, imageSize.height, size.width, size.height,
                                    isScaled ? " and others of this shape" : ""));
    if (calibrated && size.empty())
        checkPrincipalPoint(K, imageSize);
    const cv::Matx33d intrinsics = isScaled ? scaledIntrinsics(K, widthFactor, heightFactor) : K;
    RollingShutterCamera camera = calibrated ? RollingShutterCamera(imageSize, intrinsics, lens, lensModel)
                                             : RollingShutterCamera::fromFocal(imageSize, focal);
    camera.scanDirection = scan;
    const int lines = camera.isRowShutter() ? imageSize.height : imageSize.width;
    camera.lineDelay = readOut > 0 ? readOut / lines : lineDelay;
    const bool upwards = scan == SCAN_BOTTOM_TO_TOP || scan == SCAN_RIGHT_TO_LEFT;
    if (reference == "middle")
        camera.referenceRow = (lines - 1) / 2.;
    else if (reference == "first")
        camera.referenceRow = upwards ? lines - 1 : 0;
    else if (reference == "last")
        camera.referenceRow = upwards ? 0 : lines - 1;
    else
        camera.referenceRow = parseNumber(reference, "reference");
    const RollingShutterCamera ofUnknownMount = camera;
    camera.setRollPitch(roll * DEGREE, pitch * DEGREE);
    camera.rollSigma = rollIsGiven ? rollSigma * DEGREE : ofUnknownMount.rollSigma;
    camera.pitchSigma = pitchIsGiven ? pitchSigma * DEGREE : ofUnknownMount.pitchSigma;
    camera.heading = heading * DEGREE;
    camera.headingSigma = headingIsGiven ? headingSigma * DEGREE : ofUnknownMount.headingSigma;
    camera.height = height;
    camera.lineDelaySigma = lineDelaySigma;
    if (focalSigma > 0)
        camera.focalSigma = focalSigma;
    camera.check();
    checkFocalLength(camera);
    checkAxis(camera);
    return camera;
}

std::string parseReference(const std::string& text, const std::string& source)
{
    if (text != "first" && text != "middle" && text != "last")
        parseNumber(text, source + " (first, middle, last or a line's number)", -1e9, 1e9);
    return text;
}

std::string readReference(const Options& options)
{
    return parseReference(options.text("reference"), "option --reference");
}

// Of a value that is far from those of cameras in cars, as one in another unit would be. Five standard deviations: a
// right one is beyond them once in two million cameras.
static void warnIfUnusual(const Options& options, const std::string& value, double given, double median,
                          double logSigma, const char* meaning)
{
    if (given > 0 && std::abs(std::log(given / median)) > 5 * logSigma)
        options.warn(cv::format("the %s of %g isn't one of a camera in a car (about %g): %s", value.c_str(), given,
                                median, meaning));
}

static void warnOfUnusualValues(const Options& options, const CameraSettings& s)
{
    if (!s.unknownKeys.empty())
        options.warn("the camera file has keys that mean nothing here: " + s.unknownKeys);
    if (!s.severalCameras.empty())
        options.warn("the camera file has the cameras " + s.severalCameras +
                     " is taken; for another one give a file that has it alone");
    const bool readsRows = s.scan == SCAN_TOP_TO_BOTTOM || s.scan == SCAN_BOTTOM_TO_TOP;
    const double readOut = s.readOut > 0 ? s.readOut : s.lineDelay * (readsRows ? s.size.height : s.size.width);
    const AckermannEstimator::Params prior; // doc/theory.md, "Prior"
    warnIfUnusual(options, "height", s.height, prior.priorHeight, prior.priorHeightLogSigma,
                  "it is in metres above the road");
    warnIfUnusual(options, "read-out", readOut, prior.priorReadoutTime, prior.priorReadoutTimeLogSigma,
                  "it is in seconds, for all lines (readout) or between two of them (line_delay), and in "
                  "milliseconds in lens profiles (frame_readout_time)");
}

CameraSettings readCameraOptions(const Options& options)
{
    CameraSettings s;
    if (options.given("camera"))
    {
        if (options.given("focal"))
            throw UsageError("--camera and --focal exclude each other");
        readCameraFile(options.inputFile("camera"), s);
    }
    if (options.given("focal"))
        s.focal = options.positive("focal", MOST_FOCAL);
    if (options.given("focal_sigma"))
        s.focalSigma = options.positive("focal_sigma", MOST_FOCAL);
    if (options.given("line_delay") && options.given("readout"))
        throw UsageError("--line_delay and --readout exclude each other");
    if (options.given("line_delay") || options.given("readout"))
    {
        s.lineDelay = options.given("line_delay") ? options.positive("line_delay", LONGEST_READ_OUT) : 0;
        s.readOut = options.given("readout") ? options.positive("readout", LONGEST_READ_OUT) : 0;
        s.lineDelaySigma = 0;
        for (CompatibleSetting& setting : s.compatible)
            setting.readOut = s.readOut;
    }
    if (options.given("scan"))
    {
        s.scan = options.choice("scan", SCAN_WORDS);
        for (CompatibleSetting& setting : s.compatible)
            setting.scan = s.scan;
    }
    if (options.given("reference"))
        s.reference = readReference(options);
    if (options.given("roll"))
    {
        s.roll = options.number("roll", -MOST_TILT, MOST_TILT);
        s.rollSigma = 0;
        s.rollIsGiven = true;
    }
    if (options.given("pitch"))
    {
        s.pitch = options.number("pitch", -MOST_TILT, MOST_TILT);
        s.pitchSigma = 0;
        s.pitchIsGiven = true;
    }
    if (options.given("heading"))
    {
        s.heading = options.number("heading", -MOST_HEADING, MOST_HEADING);
        s.headingSigma = 0;
        s.headingIsGiven = true;
    }
    if (options.given("height"))
        s.height = options.positive("height", MOST_HEIGHT);
    warnOfUnusualValues(options, s);
    return s;
}

} // namespace rsackermann_samples
