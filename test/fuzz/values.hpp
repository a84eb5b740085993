// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_TEST_FUZZ_VALUES_HPP
#define RSACKERMANN_TEST_FUZZ_VALUES_HPP

#include "opencv2/rsackermann.hpp"
#include <cstdint>
#include <functional>
#include <fuzzer/FuzzedDataProvider.h>

// What a fuzzer calls, which no header of it declares.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace fuzz {

//! Ends the process with a message, which the fuzzer takes for a crash.
void require(bool condition, const char* message);

//! Whether all elements are finite, also of a matrix of floating-point numbers.
bool isFinite(double value);
bool isFinite(const cv::Mat& values);

/** Calls a function, which must not take more seconds of processor time in each of three calls; it may if
it is built with AddressSanitizer. Unlike the time on the clock that hardly depends on what else the machine has to do.
*/
void requireQuick(double seconds, const std::function<void()>& function);

/** Makes values for the library from the fuzzer's bytes.

Most are such as a caller would give, since others are refused before much is done; the rest is anything: NaN, infinity,
denormal and the largest numbers.
*/
class Values
{
public:
    Values(const uint8_t* data, size_t size) : bytes_(data, size) {}

    bool flag() { return bytes_.ConsumeBool(); }
    int integer(int low, int high) { return bytes_.ConsumeIntegralInRange(low, high); }
    //! A number in [low, high]; once in 32 any other.
    double number(double low, double high);
    //! The usual value, once in four number(low, high).
    double around(double usual, double low, double high);
    size_t left() { return bytes_.remaining_bytes(); }

    //! @param largest width and height at most.
    cv::rsackermann::RollingShutterCamera camera(int largest);
    cv::rsackermann::AckermannMotion motion(const cv::rsackermann::RollingShutterCamera& camera);
    cv::rsackermann::MotionPrior prior();
    cv::rsackermann::AckermannEstimator::Params estimatorParams();

private:
    double any();
    void addOffset(cv::rsackermann::AckermannMotion& motion);
    void addCurve(cv::rsackermann::AckermannMotion& motion);

    FuzzedDataProvider bytes_;
};

} // namespace fuzz

#endif // RSACKERMANN_TEST_FUZZ_VALUES_HPP
