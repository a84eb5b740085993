// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_CAMERA_SETTINGS_HPP
#define RSACKERMANN_SAMPLES_CAMERA_SETTINGS_HPP

#include "opencv2/rsackermann/camera.hpp"
#include "options.hpp"

namespace rsackermann_samples {

//! The calibration of images of another size than that of a camera's file.
struct CompatibleSetting
{
    cv::Size size;
    cv::Matx33d K;
    std::vector<double> lens;
    double readOut;      //!< seconds; 0: unknown
    int scan;            //!< a cv::rsackermann::ScanDirection
    std::string refusal; //!< why such images can't be used; empty if they can
};

//! A camera as files and options describe it; values that depend on the image's size are left open until an image is
//! there.
struct CameraSettings
{
    bool calibrated; //!< whether K, lens and lensModel are known
    cv::Size size;   //!< of the calibration; 0 x 0: unknown
    bool isScaled;   //!< whether the calibration also is that of images of other sizes but the same shape
    cv::Matx33d K;
    std::vector<double> lens;
    int lensModel;
    double focal;              //!< pixels, of an uncalibrated camera; 0: 0.9 times the longer side
    double lineDelay, readOut; //!< seconds; 0: unknown
    int scan;
    std::string reference;                          //!< first, middle or last line to be read, or a line's number
    double roll, pitch, heading;                    //!< degrees
    bool rollIsGiven, pitchIsGiven, headingIsGiven; //!< else the camera isn't level, or looks elsewhere
    double height;                                  //!< metres; 0: unknown
    double rollSigma, pitchSigma, headingSigma, lineDelaySigma; //!< standard deviations in the same units; 0: not known
    double focalSigma;                                          //!< pixels; 0: not known
    std::vector<CompatibleSetting> compatible;                  //!< with #isScaled
    std::string unknownKeys;    //!< of a file, with commas between, which have no effect
    std::string severalCameras; //!< of a file, and which of them is taken; empty if it has one
    bool needsReadOut;          //!< whether one that depends on more than the size is an error; it is unknown otherwise

    CameraSettings();

    /** The camera for an image.
    Throws InputError if the image hasn't the size of a calibration, or the shape if that is scaled, or if a calibration
    of unknown size is evidently of another, or the focal length too short for pixels. */
    cv::rsackermann::RollingShutterCamera makeCamera(const cv::Size& imageSize) const;

    /** The same with the calibration that counts for images of a size, and no others: the first one of that size, else
    the first one of that shape. Throws InputError if its images can't be used, or its shutter is ambiguous. */
    CameraSettings forSize(const cv::Size& imageSize) const;

    //! The same with one of the compatible calibrations, and no others.
    CameraSettings with(const CompatibleSetting& setting) const;

    //! Whether the time between two lines is known, of images of some size at least.
    bool hasLineDelay() const;
};

//! What is to be said of a camera whose read-out takes longer than the seconds between frames; empty if it doesn't.
std::string doubtOfReadOut(const cv::rsackermann::RollingShutterCamera& camera, double interval);

/** The camera matrix of images that are scaled by factors for width and height: the centre of the first pixel is at 0,
and the sides of the image stay its sides. */
cv::Matx33d scaledIntrinsics(cv::Matx33d K, double widthFactor, double heightFactor);

//! The words for cv::rsackermann::ScanDirection, in its order.
extern const std::vector<std::string> SCAN_WORDS;

//! Keys of the options that readCameraOptions() takes.
extern const char* const CAMERA_KEYS;

//! Largest values of options and of camera files: degrees, metres and pixels.
const double MOST_TILT = 89, MOST_HEADING = 180, MOST_HEIGHT = 1000, MOST_FOCAL = 1e7;

//! A reference: a word, or a number that an image's line may have. Throws UsageError which names its source.
std::string parseReference(const std::string& text, const std::string& source);

//! The value of --reference.
std::string readReference(const Options& options);

//! Reads --camera and the other options for a camera, which go before the file.
CameraSettings readCameraOptions(const Options& options);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_CAMERA_SETTINGS_HPP
