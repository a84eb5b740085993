// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_PHOTO_SETS_HPP
#define RSACKERMANN_PERF_PHOTO_SETS_HPP

#include "opencv2/rsackermann.hpp"
#include <functional>
#include <string>
#include <vector>

namespace paper {

//! A rolling-shutter image from a folder, and how well a correction does.
struct PhotoCase
{
    std::string name;
    cv::rsackermann::RollingShutterCamera camera;
    double wallDistance; //!< metres to the left wall; 0: unknown
    cv::Mat image;
    cv::Mat global; //!< image of a global shutter; empty: there is none
    //! Measures a correction by maps of cv::remap: what it says of the raw image and of the corrected one.
    std::function<void(const cv::Mat& columns, const cv::Mat& rows, double& before, double& after)> measure;
};

//! Images of one kind.
struct PhotoSet
{
    std::string kind;    //!< photographs, frames or drive
    std::string measure; //!< what is measured: displacement_px or psnr_db
    std::string folder;
    int size;
    std::function<PhotoCase(int)> at;
};

/** The sets of a folder and of the folders in it. By the columns of frames.csv: global-shutter photographs of streets,
which are distorted with known motion; rolling-shutter frames with their global-shutter images; consecutive frames of a
drive, of which every sixth is taken. */
std::vector<PhotoSet> findPhotoSets(const std::string& folder);

} // namespace paper

#endif // RSACKERMANN_PERF_PHOTO_SETS_HPP
