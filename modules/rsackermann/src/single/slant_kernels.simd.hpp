// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY
#include "../simd_pack.hpp"
#endif
#include "slant_noise.hpp"

namespace cv { namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

SlantSums sumSlants(const SlantArrays& slants, const SlantNoise& noise, double error);
double slantLikelihood(const SlantArrays& slants, const SlantNoise& noise, double error);

#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

namespace {

typedef PackOf<double> Pack;

// Some slants' densities as those of verticals and of other lines, each with its share.
struct Densities
{
    Pack variance; // of verticals
    SlantDensity<Pack> vertical, other;
    Pack ofVertical, ofOther;

    Densities(const SlantArrays& s, int i, const SlantNoise& noise, double error)
        : Densities(Pack::load(s.slantSquares() + i),
                    Pack(noise.lean * noise.lean) + Pack(error * error) * Pack::load(s.inverseLengthSquares() + i),
                    noise)
    {
    }

private:
    Densities(const Pack& slant2, const Pack& variance_, const SlantNoise& noise)
        : variance(variance_), vertical(squareRoot(variance_), variance_, slant2),
          other(Pack(noise.otherLean), Pack(noise.otherLean * noise.otherLean), slant2),
          ofVertical(Pack(1 - noise.share) * vertical.value), ofOther(Pack(noise.share) * other.value)
    {
    }
};

} // namespace

SlantSums sumSlants(const SlantArrays& slants, const SlantNoise& noise, double error)
{
    const Pack zero(0.), one(1), lean2(noise.lean * noise.lean);
    Pack verticals(0.), squares(0.), otherSquares(0.);
    for (int i = 0; i < slants.size(); i += Pack::COUNT)
    {
        const Densities d(slants, i, noise, error);
        const Pack isSlant = choose(Pack::load(slants.inverseLengthSquares() + i) > zero, one, zero);
        const Pack isVertical = isSlant * d.ofVertical / (d.ofVertical + d.ofOther), part = lean2 / d.variance;
        verticals = verticals + isVertical;
        squares = squares + isVertical * (part * part * d.vertical.weighedSquare() + lean2 * (one - part));
        otherSquares = otherSquares + (isSlant - isVertical) * d.other.weighedSquare();
    }
    const SlantSums sums = {verticals.sum(), squares.sum(), otherSquares.sum()};
    return sums;
}

double slantLikelihood(const SlantArrays& slants, const SlantNoise& noise, double error)
{
    double sum = 0;
    for (int i = 0; i < slants.size(); i += Pack::COUNT)
    {
        const Densities d(slants, i, noise, error);
        double densities[Pack::COUNT];
        (d.ofVertical + d.ofOther).store(densities);
        // Far from overflow: densities are between 1e-12 and 1e7.
        double product = 1;
        for (int k = 0; k < std::min<int>(Pack::COUNT, slants.size() - i); k++)
            product *= densities[k];
        sum += std::log(product);
    }
    return sum;
}

#endif // CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
