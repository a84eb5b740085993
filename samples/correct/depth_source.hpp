// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_DEPTH_SOURCE_HPP
#define RSACKERMANN_SAMPLES_DEPTH_SOURCE_HPP

#include "depth_file.hpp"
#include "inputs.hpp"

namespace rsackermann_samples {

class Options;

//! The depth files of a job: one for each image and each frame of a video, or none.
class DepthSource
{
public:
    DepthSource() {} //!< no depths

    //! Reads the options --depth, --depth_kind, --depth_camera, --depth_scale, --depth_scale_sigma and --baseline;
    //! throws UsageError.
    DepthSource(const Options& options, const InputList& inputs);

    const DepthMeaning& meaning() const { return meaning_; }
    //! The file that belongs to an image; it need not exist. Empty: there are no depths.
    std::string fileOf(const Input& image) const;
    //! That of a video's frame, whose number is counted from 0.
    std::string fileOfFrame(const std::string& video, int frame) const;
    //! All that may be read.
    const std::vector<std::string>& files() const { return files_; }

private:
    std::string folder_;             // if it is one
    std::vector<std::string> files_; // by the number of the input if it isn't
    DepthMeaning meaning_;
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_DEPTH_SOURCE_HPP
