// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_DEPTH_FILE_HPP
#define RSACKERMANN_SAMPLES_DEPTH_FILE_HPP

#include "opencv2/rsackermann/depth_map.hpp"
#include <string>

namespace rsackermann_samples {

//! What the numbers of depth files mean.
struct DepthMeaning
{
    enum Kind { METRIC, DISPARITY, RELATIVE };

    Kind kind;
    int camera;        //!< a cv::rsackermann::DepthCamera
    double scale;      //!< metres, or pixels of disparity, per unit; 0: usual ones; not of a relative depth
    double scaleSigma; //!< relative, of the metres
    double baseline;   //!< metres between the cameras of a disparity

    DepthMeaning()
        : kind(METRIC), camera(cv::rsackermann::DEPTH_RAW), scale(0),
          scaleSigma(cv::rsackermann::DepthMap().scaleSigma), baseline(0)
    {
    }
};

/** Reads a depth from an image of 16 bits or of floating-point numbers with one channel, a .npy file, or a table of
points (.csv) in the frame of the corrected camera.

Throws InputError. Usual scales are 0.001 m and 1/256 px for whole numbers, 1 m and 1 px for others.
@param camera to the size of whose image other sizes are scaled. */
cv::rsackermann::DepthMap readDepth(const std::string& path, const DepthMeaning& meaning,
                                    const cv::rsackermann::RollingShutterCamera& camera);

//! A matrix of two dimensions from the bytes of a .npy file: numbers of 16 bits without a sign (CV_16U), or floats of
//! 32 or 64 bits (CV_32F, CV_64F), rows first. Throws InputError for others and for damaged files.
cv::Mat decodeNpy(const std::vector<uchar>& bytes);

/** Points from a CSV table whose header has x, y and z (N x 3, CV_64F; nan is kept). Throws InputError with the line
that isn't understood, and if the table is one of several images: if it has a column file with other names than one. */
cv::Mat readPointCloud(const std::string& path);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_DEPTH_FILE_HPP
