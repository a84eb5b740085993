// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_REPORT_HPP
#define RSACKERMANN_SAMPLES_REPORT_HPP

#include "files.hpp"
#include "opencv2/rsackermann.hpp"
#include <fstream>
#include <memory>

namespace rsackermann_samples {

//! What is to be told about a frame.
struct FrameReport
{
    FrameReport() : frame(-1), segments(0), meanShift(0) {}

    std::string input;
    int frame;         //!< number of a video's frame, from 0; -1: the input is an image
    cv::rsackermann::RollingShutterCamera camera;
    cv::rsackermann::AckermannMotion motion;
    int segments;
    double meanShift;  //!< pixels, mean distance between the maps and those that only undo the lens
    cv::Vec4d timings; //!< milliseconds of detection, estimation, maps and remapping
};

//! A line of JSON; what isn't known is null.
std::string reportLine(const FrameReport& frame);

//! A file with a line of JSON for each frame, or standard output where its name is "-".
class ReportFile
{
public:
    //! @param keep whether the lines of an existing file are kept.
    ReportFile(const std::string& path, bool keep);
    void add(const std::string& line);
    void commit();

private:
    std::unique_ptr<AtomicFile> file_;
    std::ofstream stream_;
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_REPORT_HPP
