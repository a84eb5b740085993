// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_TEST_THREADS_HPP
#define OPENCV_RSACKERMANN_TEST_THREADS_HPP

#include "test_simulator.hpp"
#include "opencv2/imgproc.hpp"
#include <thread>

namespace opencv_test {

const int THREADS = 4;

//! Runs a function for 0, 1, ... in a thread each.
template <class Function>
void inThreads(const Function& function)
{
    std::vector<std::thread> threads;
    for (int i = 0; i < THREADS; i++)
        threads.push_back(std::thread([&function, i]() { function(i); }));
    for (size_t i = 0; i < threads.size(); i++)
        threads[i].join();
}

inline simulation::Simulator street(int i)
{
    return simulation::Simulator::fromMetric(simulation::paperCamera(), 0.1 * (i + 1), 12 + 3 * i, 2.5, 3, 0);
}

inline Mat streetSegments(int i)
{
    RNG rng(i + 1);
    simulation::SegmentOptions options;
    options.count = 40;
    options.noise = 0.2;
    return simulation::randomSegments(street(i), options, rng).ends;
}

//! White lines, as many as there are segments.
inline Mat streetImage(int i)
{
    const Mat segments = streetSegments(i);
    Mat image(simulation::paperCamera().imageSize, CV_8UC1, Scalar(60));
    for (int k = 0; k < segments.rows; k++)
    {
        const double* s = segments.ptr<double>(k);
        line(image, Point(cvRound(16 * s[0]), cvRound(16 * s[1])), Point(cvRound(16 * s[2]), cvRound(16 * s[3])),
             Scalar(230), 3, LINE_AA, 4);
    }
    return image;
}

} // namespace opencv_test

#endif // OPENCV_RSACKERMANN_TEST_THREADS_HPP
