// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_GYRO_SAMPLES_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_GYRO_SAMPLES_HPP

#include "opencv2/core.hpp"
#include <vector>

namespace cv { namespace rsackermann {

/** The rates that a gyro has measured about the axes of the camera, and how far it has turned: cubic between samples.

Times are those of the gyro's clock, in seconds; angles are first integrals of the rates, which add up as long as turns
are small. */
class GyroSamples
{
public:
    static double fastest() { return 1e3; } //!< rad/s; faster ones are wrong

    //! @param times seconds, increasing, after those that are there: N x 1 or 1 x N, CV_64F. @param rates rad/s about
    //! x, y and z: N x 3, CV_64F. Throws cv::Exception if they are others, or faster than fastest().
    //! @param origin seconds that are taken off the times.
    void add(const Mat& times, const Mat& rates, double origin = 0);
    void clear();
    //! Forgets samples before a time once they are the most.
    void forgetBefore(double time);
    bool empty() const { return samples.empty(); }
    double lastTime() const { return samples.back().time; }

    //! Whether there are samples all along from one time to a later one.
    bool covers(double begin, double end) const;

    /** The mean rates from one instant to a later one, averaged over instants that are later by from .. to seconds.
    @return false if samples are missing. */
    bool meanRate(double begin, double end, double from, double to, Vec3d& rate) const;

    //! How far it has turned since the first sample, radians, at a time that is covered.
    Vec3d angleAt(double time) const;

    //! How far it has turned from one instant to a later one, radians. @return false if samples are missing.
    bool turn(double begin, double end, Vec3d& angle) const;

    /** The rates that turn the rows of an image most nearly as the gyro has turned: least squares of the angle since an
    instant, over the times that are later by from .. to seconds.
    @return false if samples are missing. */
    bool rowRate(double instant, double from, double to, Vec3d& rate) const;

    /** The noise of its angles, rad^2/s: white noise of the samples, of which the eighth differences show hardly
    anything else (doc/theory.md, "Self-calibration"). 0 if there are too few. Those that are forgotten count. */
    double angleNoise() const;

private:
    struct Sample
    {
        double time;
        Vec3d rate, slope, angle; // slope of the rate
        int gaps;                 // before it
    };

    //! Sums of the noise in the samples' eighth differences.
    struct Noise
    {
        double squares = 0, seconds = 0, count = 0;

        //! Adds the difference that ends at the last sample.
        void add(const std::vector<Sample>& all);
    };

    void integrate(size_t k);
    size_t before(double time) const;

    std::vector<Sample> samples;
    Noise noise;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_GYRO_SAMPLES_HPP
