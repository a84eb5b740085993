// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_TRUTH_FILE_HPP
#define RSACKERMANN_SAMPLES_TRUTH_FILE_HPP

#include "street_renderer.hpp"

namespace rsackermann_samples {

//! Camera and scene of a simulated image.
struct Truth
{
    street::StreetCamera camera;
    street::StreetScene scene;
};

//! The truth as JSON, with angles in degrees and the speed in km/h; it suffices to make the true map. The rates
//! of the camera, at the reference line, are those about its own axes: the car's and those of its shaking. So is
//! viewmat, street::viewMatrix().
std::string truthText(const Truth& truth);
//! The same in one line, of a frame of a drive.
std::string truthLine(const std::string& file, const Truth& truth);
//! Reads a file with the text of truthText(); throws InputError.
Truth readTruth(const std::string& path);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_TRUTH_FILE_HPP
