// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_FRAME_INDEX_HPP
#define RSACKERMANN_SAMPLES_FRAME_INDEX_HPP

#include <string>
#include <vector>

namespace rsackermann_samples {

/** What the index of a container (MP4 and MOV, also with fragments; Matroska and WebM) has on the frames of its
video.

OpenCV doesn't report the times of the frames that a decoder gives back after the last packet (as many as it delays, by
frames that are shown earlier than they are stored and by threads), and counts frames that an edit list hides. */
struct FrameIndex
{
    //! Seconds from the first frame that is shown, in the order in which they are shown; empty: unknown.
    std::vector<double> times;
    //! Frames that the edit list shows, at least: decoders go on to the end of a group of pictures. 0: unknown
    size_t shown;
};

FrameIndex readFrameIndex(const std::string& path);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_FRAME_INDEX_HPP
