// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_FRAME_CORRECTOR_HPP
#define RSACKERMANN_SAMPLES_FRAME_CORRECTOR_HPP

#include "job.hpp"
#include "report.hpp"

namespace rsackermann_samples {

//! Corrects the inputs of a job one by one and writes their results.
class FrameCorrector
{
public:
    explicit FrameCorrector(const Job& job) : job_(job) {}

    //! Whether the result of an input is there already and is to be left alone.
    bool isDone(const std::string& input) const;

    //! Reads an image, corrects it and writes what is asked for; throws InputError or cv::Exception.
    FrameReport process(const std::string& input);

private:
    void checkTargets(const std::string& input) const;
    void prepare(const cv::Size& size);
    void writeMaps(const std::string& path, const cv::Mat& map1, const cv::Mat& map2) const;

    const Job& job_;
    cv::rsackermann::RollingShutterCamera camera_; // of the images of the last size
    cv::Ptr<cv::rsackermann::RollingShutterCorrector> corrector_;
    cv::Mat lensMap1_, lensMap2_;                  // undo the lens only
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_FRAME_CORRECTOR_HPP
