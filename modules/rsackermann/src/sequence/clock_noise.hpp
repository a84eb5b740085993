// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_SEQUENCE_CLOCK_NOISE_HPP
#define OPENCV_RSACKERMANN_SRC_SEQUENCE_CLOCK_NOISE_HPP

#include "row_rates.hpp"

namespace cv { namespace rsackermann {

/** How vaguely the times of frames are known, by the speeds that they seem to have (doc/theory.md, "Rates of rows").

A time that is late makes one frame too slow and the next one too fast; cars that brake don't.
*/
class ClockNoise
{
public:
    //! @param memory_ seconds.
    explicit ClockNoise(double memory_ = RATE_MEMORY) : memory(memory_) {}

    //! Adds a frame. @param speed as the time since the frame before has it. @param interval that time, seconds.
    void add(double speed, double interval)
    {
        const double kept = std::exp(-std::abs(interval) / memory), difference = speed - last;
        if (known > 1)
        {
            products = kept * products + change * difference;
            // Of the three speeds, so that one near 0 doesn't divide by nothing.
            const double first = last - change;
            squares = kept * squares + (first * first + last * last + speed * speed) / 3;
            count = kept * count + 1;
        }
        change = difference;
        last = speed;
        known = std::min(known + 1, 2);
    }

    //! The next frame doesn't follow the last one.
    void interrupt() { known = 0; }

    /** Standard deviation of an interval, relative to it: errors of times with the variance v, relative to the square
    of the interval, give it the variance 2 v, and changes that follow each other the covariance -4 v of the square of
    the speed. */
    double sigma() const
    {
        return products < 0 ? std::sqrt(-products / (2 * squares) * count / (count + ASSUMED_FRAMES)) : 0;
    }

private:
    double memory;
    double last = 0, change = 0;                 // of the speed
    double products = 0, squares = 0, count = 0; // of changes that follow each other, and of speeds
    int known = 0;                               // speeds
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_SEQUENCE_CLOCK_NOISE_HPP
