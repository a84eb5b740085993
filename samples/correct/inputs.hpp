// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_INPUTS_HPP
#define RSACKERMANN_SAMPLES_INPUTS_HPP

#include <string>
#include <utility>
#include <vector>

namespace rsackermann_samples {

//! The images and videos that the arguments of a program stand for.
struct InputList
{
    std::vector<std::string> files;
    //! The place of each file in the list, from 0; a shard keeps it
    std::vector<int> numbers;
    std::vector<std::pair<std::string, std::string>> failures; //!< arguments that stand for nothing, and why
    bool single;                                               //!< there is one argument and it is the name of a file
};

/** Lists the files: an argument is an image, a video, a directory (its images, by name), a printf pattern as
frame_%04d.png (by number) or @FILE with a name a line. */
InputList listInputs(const std::vector<std::string>& arguments);

//! Whether a file is a video, by the extension of its name.
bool isVideo(const std::string& path);

//! Keeps every count-th input, beginning with the one that shard stands for.
void keepShard(InputList& inputs, int shard, int count);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_INPUTS_HPP
