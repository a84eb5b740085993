// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_SIMULATE_DRIVE_FILES_HPP
#define RSACKERMANN_SAMPLES_SIMULATE_DRIVE_FILES_HPP

#include "camera_settings.hpp"
#include "rendered_drive.hpp"
#include "simulated_gyro.hpp"

namespace rsackermann_samples {

//! A drive to be rendered, and the files that it makes.
struct DriveFiles
{
    std::string folder; //!< with a slash at its end
    int frames, samples;
    CameraSettings camera;
    street::SimulatedGyro gyro;
    bool depth, global; //!< whether there are depth/NNNNNN.png and global/NNNNNN.png
    street::StreetRenderer::Rays rays;

    //! Names of all files.
    std::vector<std::string> names() const;

    /** Renders the drive: frames/NNNNNN.png and what else is wanted of each, and once they are there log.csv with their
    times, gyro.csv, truth.jsonl (a line for each frame) and camera.yml. Before there is a file it throws UsageError if
    the car reaches a wall, and InputError if the folder has more frames. */
    void write(const street::RenderedDrive& drive) const;

private:
    std::string frameName(int number) const;
    std::vector<std::string> folders() const;
    std::string gyroText(const street::RenderedDrive& drive) const;
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_SIMULATE_DRIVE_FILES_HPP
