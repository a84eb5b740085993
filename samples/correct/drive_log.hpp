// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_DRIVE_LOG_HPP
#define RSACKERMANN_SAMPLES_DRIVE_LOG_HPP

#include "inputs.hpp"
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace rsackermann_samples {

//! Facts on a frame, in the units of the options; NaN: not given.
struct FrameFacts
{
    double time;                      //!< seconds at which the frame's reference row was read
    double speed, speedSigma;         //!< km/h
    double yawRate, yawRateSigma;     //!< deg/s
    double roll, pitch, gravitySigma; //!< degrees
    double intervals;                 //!< that have passed since the frame before if the time isn't given, of no log
    bool isLogged;                    //!< whether the log knows the frame: its time if there are samples, else its name

    FrameFacts();
};

//! Of images of a drive of which no log has the times.
const char* const NO_TIMES =
    "images without a time are taken for 1/30 s apart, or by their numbers for that of frames that are missing, and "
    "speeds and yaw rates are wrong where they aren't: give --log with the column time_s";

/** The log of a drive: a CSV file with a header.

The columns are any of file, frame, time_s, speed_kmh, speed_sigma_kmh, yaw_rate_deg_s, yaw_rate_sigma_deg_s, roll_deg,
pitch_deg and gravity_sigma_deg; empty cells give nothing. A row that names a frame is about that frame alone: by an
image's file, by a number, or, if there are several videos, by file and number. All other rows are samples: between two
of them a value changes linearly in time.
*/
class DriveLog
{
public:
    //! A log that gives nothing.
    DriveLog() {}

    //! Throws UsageError with the row and the column of whatever isn't known or isn't understood.
    explicit DriveLog(const std::string& path);

    /** The facts on a frame.
    @param file the input's name; the log may have it as it is or without its folders.
    @param number the place of an image among the inputs, or of a frame in a video, from 0.
    @param time seconds, if they are known from elsewhere; a row that names the frame goes before. NaN: unknown. */
    FrameFacts of(const std::string& file, int number, double time) const;

    //! Whether there is no row.
    bool empty() const { return named_.empty() && samples_.empty(); }
    //! What is wrong with a log that has rows and knows no frame.
    std::string whyUseless() const;
    //! The name under which the log has an input: with its folders, else without; empty: it doesn't name it.
    std::string nameOf(const std::string& file) const;
    //! Whether a row names the frame.
    bool names(const std::string& file, int number) const { return named(file, number) != nullptr; }
    //! Throws UsageError if two rows name one frame of the inputs.
    void checkNames(const InputList& inputs) const;
    //! Whether a row names a frame by its number alone.
    bool hasNumberAlone() const;
    //! Whether a speed or a yaw rate is given anywhere.
    bool hasSpeed() const { return has(&FrameFacts::speed); }
    bool hasYawRate() const { return has(&FrameFacts::yawRate); }

    //! Seconds between the two samples that follow most closely, of files that have three or more; 0: there are none.
    double shortestStep() const;

private:
    typedef std::pair<std::string, int> Key; // file, empty: any; number, -1: an image that is named by its file

    struct Row
    {
        FrameFacts facts;
        int line;
    };

    const FrameFacts* named(const std::string& file, int number) const;
    const std::vector<FrameFacts>* samplesOf(const std::string& file) const;
    bool has(double FrameFacts::*value) const;

    std::string path_;
    std::map<Key, Row> named_;
    std::map<std::string, std::vector<FrameFacts>> samples_; // by the video's name, empty: any; increasing in time
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_DRIVE_LOG_HPP
