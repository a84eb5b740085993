// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_IMAGE_TASK_HPP
#define RSACKERMANN_SAMPLES_IMAGE_TASK_HPP

#include "frame_corrector.hpp"
#include "image_metadata.hpp"
#include "output/atomic_file.hpp"
#include "targets.hpp"

namespace rsackermann_samples {

//! What the file of an image holds.
struct StoredImage
{
    cv::Mat pixels;
    ImageMetadata metadata;
};

//! Throws InputError or cv::Exception.
StoredImage readStored(const std::string& input);

//! Writes the results of an image; they appear when they are committed. Throws InputError or cv::Exception.
AtomicFiles writeResults(const std::string& input, const StoredImage& stored, const CorrectedFrame& frame,
                         const Targets& targets);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_IMAGE_TASK_HPP
