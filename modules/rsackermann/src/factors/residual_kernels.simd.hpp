// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY
#include "../simd_pack.hpp"
#include "direction_terms.hpp"
#include "vertical_terms.hpp"
#include <functional>
#include <numeric>
#endif
#include "residual_kernels.hpp"

namespace cv { namespace rsackermann {

CV_CPU_OPTIMIZATION_NAMESPACE_BEGIN

void addVerticals(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss,
                  const FreeParameters& unknowns, ResidualSums& sums);
void addDirections(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss,
                   const FreeParameters& unknowns, ResidualSums& sums);
void addVerticalsInSinglePrecision(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss,
                                   const FreeParameters& unknowns, ResidualSums& sums);
double scoreVerticals(const SegmentArrays& segments, const PreparedModel& model, double focal, double threshold,
                      double best, int& inliers);
void compensateSegments(const SegmentArrays& segments, const PreparedModel& model, float* points);
double streetCost(const float* points, int padded, double streetX, double streetZ, double scale);
SlantSums sumSlants(const Slants& slants, const SlantNoise& noise, double error);
double slantLikelihood(const Slants& slants, const SlantNoise& noise, double error);

#ifndef CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

namespace {

//! The angles of a car's motion seldom leave the range of the series: one by one.
template <class Number>
void sincTerms(const PackOf<Number>& x, PackOf<Number>& sincX, PackOf<Number>& cosX, PackOf<Number>& slope)
{
    Number angles[PackOf<Number>::COUNT], s[PackOf<Number>::COUNT], c[PackOf<Number>::COUNT], d[PackOf<Number>::COUNT];
    x.store(angles);
    sincX.store(s);
    cosX.store(c);
    slope.store(d);
    for (int i = 0; i < PackOf<Number>::COUNT; i++)
        if (std::abs(angles[i]) > LARGEST_IN_SERIES)
        {
            double exactSinc, exactCos, exactSlope;
            rsackermann::sincTerms(angles[i], exactSinc, exactCos, exactSlope);
            s[i] = Number(exactSinc);
            c[i] = Number(exactCos);
            d[i] = Number(exactSlope);
        }
    sincX = PackOf<Number>::load(s);
    cosX = PackOf<Number>::load(c);
    slope = PackOf<Number>::load(d);
}

typedef PackOf<double> Doubles;
typedef PackOf<float> Floats;

template <class Number>
PackOf<Number> load(const SegmentArrays& segments, SegmentArrays::Field field, int i)
{
    return PackOf<Number>::load(segments.at(field, Number()) + i);
}

template <class Number>
RotatedEnd<PackOf<Number>> endU(const SegmentArrays& s, int i, const PreparedModel& m)
{
    return RotatedEnd<PackOf<Number>>(load<Number>(s, SegmentArrays::U_X, i), load<Number>(s, SegmentArrays::U_Y, i),
                                      load<Number>(s, SegmentArrays::TIME_U, i), m);
}

template <class Number>
RotatedEnd<PackOf<Number>> endV(const SegmentArrays& s, int i, const PreparedModel& m)
{
    return RotatedEnd<PackOf<Number>>(load<Number>(s, SegmentArrays::V_X, i), load<Number>(s, SegmentArrays::V_Y, i),
                                      load<Number>(s, SegmentArrays::TIME_V, i), m);
}

// ResidualSums in vectors. Products of derivatives are summed for a block of vectors at once: each sum goes to memory
// and back once a block.
template <class Number>
class Sums
{
    typedef PackOf<Number> Pack;

public:
    Sums(const RobustLoss& loss_, const FreeParameters& unknowns_)
        : unknowns(unknowns_), loss(loss_), cost(0.), filled(0)
    {
        for (int i = 0; i < unknowns.count; i++)
        {
            gradient[i] = Pack(0.);
            for (int j = 0; j <= i; j++)
                hessian[i][j] = Pack(0.);
        }
    }

    // The residual scale * value of a segment; padding has the scale 0.
    void add(const Pack& value, const Pack* by, const Pack& scale)
    {
        const Pack r = scale * value, r2 = r * r;
        const Pack w = choose(scale > Pack(0.), loss.slope(r2), Pack(0.));
        cost = cost + loss.cost(r2);
        weight[filled] = w;
        residual[filled] = r;
        for (int i = 0; i < unknowns.count; i++)
            scaled[i][filled] = by[unknowns.index[i]] * scale;
        if (++filled == BLOCK)
            addProducts();
    }

    void addTo(ResidualSums& sums)
    {
        const Pack zero(0.);
        Pack none[PARAMETERS];
        std::fill(none, none + PARAMETERS, zero);
        while (filled > 0) // up to a whole block
            add(zero, none, zero);
        sums.cost += cost.sum();
        for (int i = 0; i < unknowns.count; i++)
        {
            sums.gradient[i] += gradient[i].sum();
            for (int j = 0; j <= i; j++)
                sums.hessian[i][j] += hessian[i][j].sum();
        }
    }

private:
    enum { BLOCK = 4 };

    void addProducts()
    {
        for (int i = 0; i < unknowns.count; i++)
        {
            const Pack* by = scaled[i];
            const Pack a = by[0] * weight[0], b = by[1] * weight[1], c = by[2] * weight[2], d = by[3] * weight[3];
            gradient[i] = gradient[i] + a * residual[0] + b * residual[1] + c * residual[2] + d * residual[3];
            for (int j = 0; j <= i; j++)
            {
                const Pack* other = scaled[j];
                hessian[i][j] = hessian[i][j] + a * other[0] + b * other[1] + c * other[2] + d * other[3];
            }
        }
        filled = 0;
    }

    const FreeParameters& unknowns;
    GemanMcClureLoss<Pack> loss;
    Pack cost;
    Pack gradient[PARAMETERS], hessian[PARAMETERS][PARAMETERS];
    int filled;
    Pack weight[BLOCK], residual[BLOCK], scaled[PARAMETERS][BLOCK];
};

// Some slants' densities as those of verticals and of other lines, each with its share.
struct Densities
{
    Doubles variance; // of verticals
    SlantDensity<Doubles> vertical, other;
    Doubles ofVertical, ofOther;

    //! @param count of the slants from the first one on.
    Densities(const double* slant, const double* length, int count, const SlantNoise& noise, double error)
        : Densities(loadFirst(slant, count), Doubles(error) / loadFirst(length, count), noise)
    {
    }

private:
    Densities(const Doubles& slant, const Doubles& placed, const SlantNoise& noise)
        : variance(Doubles(noise.lean * noise.lean) + placed * placed),
          vertical(squareRoot(variance), variance, slant * slant),
          other(noise.otherLean, noise.otherLean * noise.otherLean, slant * slant),
          ofVertical(Doubles(1 - noise.share) * vertical.value), ofOther(Doubles(noise.share) * other.value)
    {
    }
};

// Calls use(densities, count) for all slants.
template <class Use>
void forEachDensities(const Slants& slants, const SlantNoise& noise, double error, const Use& use)
{
    for (int i = 0; i < int(slants.size()); i += Doubles::COUNT)
    {
        const int count = std::min(int(slants.size()) - i, int(Doubles::COUNT));
        use(Densities(&slants.slant[i], &slants.length[i], count, noise, error), count);
    }
}

// Of the first values.
double sumOf(const Doubles& values, int count)
{
    double all[Doubles::COUNT];
    values.store(all);
    return std::accumulate(all, all + count, 0.);
}

template <class Number>
void sumVerticals(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss,
                  const FreeParameters& unknowns, ResidualSums& sums)
{
    const bool tilt = unknowns.hasTilt();
    Sums<Number> total(loss, unknowns);
    for (int i = 0; i < segments.size(); i += PackOf<Number>::COUNT)
    {
        const RotatedEnd<PackOf<Number>> u = endU<Number>(segments, i, model), v = endV<Number>(segments, i, model);
        const VerticalTerms<PackOf<Number>> residual(u, v, model);
        PackOf<Number> by[PARAMETERS];
        if (unknowns.count > 0)
            residual.derivatives(u, v, model, tilt, by);
        total.add(residual.value, by, load<Number>(segments, SegmentArrays::SCALE, i));
    }
    total.addTo(sums);
}

} // namespace

void addVerticals(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss,
                  const FreeParameters& unknowns, ResidualSums& sums)
{
    sumVerticals<double>(segments, model, loss, unknowns, sums);
}

void addVerticalsInSinglePrecision(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss,
                                   const FreeParameters& unknowns, ResidualSums& sums)
{
    sumVerticals<float>(segments, model, loss, unknowns, sums);
}

// In single precision, which is 1e-4 pixels: they lean by far more.
void addDirections(const SegmentArrays& segments, const PreparedModel& model, const RobustLoss& loss,
                   const FreeParameters& unknowns, ResidualSums& sums)
{
    const bool tilt = unknowns.hasTilt();
    const Floats streetX(model.streetX), streetZ(model.streetZ);
    Sums<float> total(loss, unknowns);
    for (int i = 0; i < segments.size(); i += Floats::COUNT)
    {
        const RotatedEnd<Floats> u = endU<float>(segments, i, model), v = endV<float>(segments, i, model);
        const CompensatedEnd<Floats> a(u, model), b(v, model);
        const DirectionTerms<Floats> residual(Chord<Floats>(a.x, a.y, b.x, b.y), streetX, streetZ);
        Floats by[PARAMETERS];
        if (unknowns.count > 0)
            residual.derivatives(u, v, a, b, model, tilt, by);
        total.add(residual.value, by, load<float>(segments, SegmentArrays::SCALE, i));
    }
    total.addTo(sums);
}

// In single precision, which is 1e-4 pixels: a score only chooses among samples.
double scoreVerticals(const SegmentArrays& segments, const PreparedModel& model, double focal, double threshold,
                      double best, int& inliers)
{
    const Floats limit(threshold * threshold);
    const int betweenChecks = 4;
    double sum = 0, inside = 0;
    int i = 0;
    while (i < segments.size() && sum < best)
    {
        Floats part(0.), count(0.);
        for (int k = 0; k < betweenChecks && i < segments.size(); k++, i += Floats::COUNT)
        {
            const VerticalTerms<Floats> residual(endU<float>(segments, i, model), endV<float>(segments, i, model),
                                                 model);
            const Floats r = residual.value * focal, r2 = r * r;
            part = part + choose(r2 < limit, r2, limit);
            count = count + choose(r2 < limit, Floats(1), Floats(0.));
        }
        sum += part.sum();
        inside += count.sum();
    }
    // Padding has no residual.
    inliers = cvRound(inside) - std::max(i - segments.size(), 0);
    return sum;
}

void compensateSegments(const SegmentArrays& segments, const PreparedModel& model, float* points)
{
    const int padded = segments.paddedSize();
    for (int i = 0; i < padded; i += Floats::COUNT)
    {
        const CompensatedEnd<Floats> a(endU<float>(segments, i, model), model),
            b(endV<float>(segments, i, model), model);
        a.x.store(points + i);
        a.y.store(points + padded + i);
        b.x.store(points + 2 * padded + i);
        b.y.store(points + 3 * padded + i);
    }
}

double streetCost(const float* points, int padded, double streetX, double streetZ, double scale)
{
    const Floats x(streetX), z(streetZ), acrossX(-streetZ), scale2(scale * scale);
    Floats sum(0.);
    for (int i = 0; i < padded; i += Floats::COUNT)
    {
        const Chord<Floats> chord(Floats::load(points + i), Floats::load(points + padded + i),
                                  Floats::load(points + 2 * padded + i), Floats::load(points + 3 * padded + i));
        // Squares, and fractions compared without division: this is done for many directions.
        Floats along2, alongLength2, across2, acrossLength2;
        chord.momentAround(x, z, along2, alongLength2);
        chord.momentAround(acrossX, x, across2, acrossLength2);
        along2 = along2 * along2;
        across2 = across2 * across2;
        const Floats::Mask isAlong = along2 * acrossLength2 < across2 * alongLength2;
        const Floats moment2 = scale2 * choose(isAlong, along2, across2),
                     length2 = choose(isAlong, alongLength2, acrossLength2);
        sum = sum + moment2 / (length2 + moment2);
    }
    return sum.sum();
}

SlantSums sumSlants(const Slants& slants, const SlantNoise& noise, double error)
{
    const Doubles one(1), lean2(noise.lean * noise.lean);
    SlantSums sums = {0, 0, 0};
    forEachDensities(slants, noise, error, [&](const Densities& d, int count) {
        const Doubles isVertical = d.ofVertical / (d.ofVertical + d.ofOther), part = lean2 / d.variance;
        sums.verticals += sumOf(isVertical, count);
        sums.squares += sumOf(isVertical * (part * part * d.vertical.weighedSquare() + lean2 * (one - part)), count);
        sums.otherSquares += sumOf((one - isVertical) * d.other.weighedSquare(), count);
    });
    return sums;
}

double slantLikelihood(const Slants& slants, const SlantNoise& noise, double error)
{
    double sum = 0;
    forEachDensities(slants, noise, error, [&](const Densities& d, int count) {
        double densities[Doubles::COUNT];
        (d.ofVertical + d.ofOther).store(densities);
        // Far from overflow: densities are between 1e-12 and 1e7.
        sum += std::log(std::accumulate(densities, densities + count, 1., std::multiplies<double>()));
    });
    return sum;
}

#endif // CV_CPU_OPTIMIZATION_DECLARATIONS_ONLY

CV_CPU_OPTIMIZATION_NAMESPACE_END

}} // namespace cv::rsackermann
