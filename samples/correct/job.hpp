// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_JOB_HPP
#define RSACKERMANN_SAMPLES_JOB_HPP

#include "camera_settings.hpp"
#include "depth_source.hpp"
#include "drive_log.hpp"
#include "gyro_file.hpp"
#include "inputs.hpp"
#include "opencv2/rsackermann.hpp"

namespace rsackermann_samples {

//! The task of rsackermann_correct.
struct Job
{
    InputList inputs;
    CameraSettings camera;
    cv::rsackermann::RollingShutterCorrector::Params params;
    double gravitySigma; //!< degrees; NaN: not given
    cv::rsackermann::MotionPrior prior;
    DriveLog log;
    GyroRecording gyro; //!< empty: none
    DepthSource depth;
    bool smooth; //!< each frame of a drive is helped by the one after it
    bool linesGiven;
    cv::Mat lines;                             //!< segments of the only image
    std::string output, overlay, maps, report; //!< file or folder, empty: not wanted
    bool outputIsFolder, overlayIsFolder, mapsIsFolder;
    int shardCount;
    bool skipExisting, overwrite;
};

extern const char* const JOB_KEYS;

/** Sets the standard deviation of gravity, the mount's included.
@param degrees of roll and pitch, 0: exact; NaN: not given, so that nothing changes. */
void setGravitySigma(double degrees, cv::rsackermann::RollingShutterCamera& camera,
                     cv::rsackermann::AckermannEstimator::Params& params);

//! Reads the command line; throws UsageError.
Job readJob(const Options& options);

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_JOB_HPP
