// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_EXPORT_FRAMES_HPP
#define RSACKERMANN_SAMPLES_EXPORT_FRAMES_HPP

#include "opencv2/rsackermann/motion.hpp"
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace rsackermann_samples {

//! A frame whose motion is known.
struct MotionFrame
{
    std::string input;                            //!< as the report names it
    int frame;                                    //!< number of a video's frame; -1: the input is an image
    double time;                                  //!< seconds; NaN: unknown
    cv::Size size;                                //!< of the image; 0 x 0: unknown
    double roll, pitch;                           //!< degrees, of the camera in this frame; NaN: as in all frames
    bool hasCamera;                               //!< whether the report has the camera
    cv::rsackermann::RollingShutterCamera camera; //!< if so, level
    bool isDepthUsed;                             //!< whether the image was corrected with a given depth
    cv::rsackermann::AckermannMotion motion;

    MotionFrame();

    //! The camera of this frame from that of all frames; throws InputError if the image had another one.
    cv::rsackermann::RollingShutterCamera cameraOf(const cv::rsackermann::RollingShutterCamera& common) const;

    //! Throws InputError if nobody knows how many metres the car drives while the image is read.
    void checkMetres() const;

    //! A name for files of this frame: that of the image, or that of the video with the frame's number.
    std::string name() const;
    //! The same with the folders, as the report names the input: another frame has another one.
    std::string path() const;
};

//! What tables call the frames: their names, and of different inputs that share a name the paths.
std::vector<std::string> namesInTables(const std::vector<MotionFrame>& frames);

/** The frame of a line of a report that isn't that of a failure.
@param source for messages. Throws InputError, UsageError or an exception of nlohmann::json. */
MotionFrame frameOfLine(const nlohmann::json& line, const std::string& source);

//! The frames of a report of rsackermann_correct, failed ones left out; throws InputError.
std::vector<MotionFrame> readReport(const std::string& path);

/** One frame from a file of cv::FileStorage, not compressed, with what AckermannMotion::write() has written, in the
root or in the node "motion", and maybe the frame's name in the node "input"; throws InputError. */
std::vector<MotionFrame> readMotionFile(const std::string& path);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_EXPORT_FRAMES_HPP
