// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_INPUTS_HPP
#define RSACKERMANN_SAMPLES_INPUTS_HPP

#include <string>
#include <vector>

namespace rsackermann_samples {

//! An image or a video, or an argument that stands for nothing.
struct Input
{
    std::string name;
    int number;        //!< its place in the list, from 0; a shard keeps it
    double intervals;  //!< from frame to frame since the one before: 1, or more if numbers of a pattern are missing
    std::string error; //!< why the argument stands for nothing; empty: it is a file

    bool isFile() const { return error.empty(); }
};

//! The images and videos that the arguments of a program stand for, in their order. What stands for nothing has a place
//! among them: in a sequence it takes the time of an image.
struct InputList
{
    std::vector<Input> inputs;
    std::vector<std::string> lists;    //!< files whose lines are among the inputs
    std::vector<std::string> warnings; //!< of what folders hold besides
    bool single = false;               //!< there is one argument, and it is the name of a file, or of nothing
};

/** Lists the files: an argument is an image, a video, a directory (its images by name, in which runs of digits count as
numbers), a printf pattern as frame_%04d.png (by number) or @FILE with a name a line. */
InputList listInputs(const std::vector<std::string>& arguments);

//! All files that are read for the inputs.
std::vector<std::string> filesOf(const InputList& inputs);

//! Keeps every count-th input, beginning with the shard-th, which is 1 for the first one.
void keepShard(InputList& inputs, int shard, int count);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_INPUTS_HPP
