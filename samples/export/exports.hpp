// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_EXPORT_EXPORTS_HPP
#define RSACKERMANN_SAMPLES_EXPORT_EXPORTS_HPP

#include "frames.hpp"

namespace rsackermann_samples {

// What rsackermann_export writes, each made by the source of that name.

// row_poses.cpp

//! Poses of the first and the last line of each frame as JSON, and of as many between as a curve of rotations needs;
//! see doc/exports.md.
std::string rowPosesText(const cv::rsackermann::RollingShutterCamera& camera, const std::vector<MotionFrame>& frames);

// gyro_log.cpp

/** A log of Gyroflow (.gcsv) with the rates of the frames at their times, in rad/s about the camera's axes x (to the
right), y (down) and z (ahead); 0 of frames without a motion. A frame that is there twice counts as it is there last.

Throws UsageError without the camera's line delay, InputError for frames of several videos, for fewer than two frames,
and if a time is unknown or that of another frame. */
std::string gyroLogText(const cv::rsackermann::RollingShutterCamera& camera, const std::vector<MotionFrame>& frames);

// st_map.cpp

/** An STMap of a pair of CV_32FC1 maps: for each pixel the place that it is taken from, as shares of the source's width
from the left and of its height from the bottom, the sides being those of the outer pixels.

@param depth CV_16U: shares as parts of 65535, which hold no place outside of the image; CV_32F.
@return image in OpenCV's order of channels: red and green hold the shares, blue is full where there is a place in the
image.
*/
cv::Mat stMap(const cv::Mat& columns, const cv::Mat& rows, const cv::Size& source, int depth);

//! A frame's file. @param direction rectify or distort. @param format png or exr.
std::string stMapFile(const std::string& folder, const MotionFrame& frame, const std::string& direction,
                      const std::string& format);

//! Writes the files of both directions for each frame.
void writeStMaps(const std::string& folder, const std::string& format,
                 const cv::rsackermann::RollingShutterCamera& camera, const std::vector<MotionFrame>& frames);

// warp_mesh.cpp

/** A grid of nodes over the corrected image with the place of each in the raw image, for warpers that interpolate
between nodes. The outer nodes are the centres of the outer pixels. */
struct WarpMesh
{
    int columns, rows;
    std::vector<cv::Point2d> nodes;  //!< in the corrected image, row by row
    std::vector<cv::Point2d> places; //!< in the raw image
    std::vector<uchar> found;        //!< whether a node has a place
    //! Distance in pixels between the bilinear interpolation and the exact place, of the pixels that both have inside
    //! of the raw image.
    double maxError, rmsError;
};

//! @param columns, rows number of nodes, at least 2.
WarpMesh makeWarpMesh(const cv::rsackermann::RollingShutterCamera& camera,
                      const cv::rsackermann::AckermannMotion& motion, int columns, int rows);

//! The meshes of all frames as JSON; see doc/exports.md.
std::string warpMeshText(const cv::rsackermann::RollingShutterCamera& camera, const std::vector<MotionFrame>& frames,
                         int columns, int rows);

// tracks.cpp

/** Corrects the points of 2-D tracks, a CSV table with a header: file (needed if there are several frames), x and y of
a point in the raw image, and maybe depth (metres; empty: unknown). All other columns are passed on.

Throws UsageError with the line that isn't understood.
@return the table as text. x and y are the place in the corrected image; they are empty if there is none.
*/
std::string correctTracks(const std::string& path, const cv::rsackermann::RollingShutterCamera& camera,
                          const std::vector<MotionFrame>& frames);

// cloud.cpp

/** Puts the points of a lidar into the raw images, each at the instant of the row that sees it: a CSV table with a
header, file (needed if there are several frames) and x, y and z, metres in the frame of the camera (x right, y down, z
forward) at the reference row of the frame. The scene stands still. All other columns are passed on.

Throws UsageError with the line that isn't understood, and InputError for a frame whose motion has no metres.
@return the table as text with the columns u and v, the place in the raw image; they are empty if the point is behind
the camera or the image doesn't show it.
*/
std::string cloudInRawImages(const std::string& path, const cv::rsackermann::RollingShutterCamera& camera,
                             const std::vector<MotionFrame>& frames);

// colmap.cpp

//! cameras.txt of COLMAP for the corrected images.
std::string colmapCameras(const cv::rsackermann::RollingShutterCamera& camera);

//! The file of a frame's mask.
std::string colmapMask(const std::string& folder, const MotionFrame& frame);

//! Writes cameras.txt and, for each frame, a mask, which is 0 where the corrected image shows nothing.
void writeColmap(const std::string& folder, const cv::rsackermann::RollingShutterCamera& camera,
                 const std::vector<MotionFrame>& frames);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_EXPORT_EXPORTS_HPP
