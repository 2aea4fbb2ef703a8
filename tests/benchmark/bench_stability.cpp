// scratch
#include <benchmark/benchmark.h>
#include "dynamics/floquet.h"
#include "dynamics/collocation.h"
#include "dynamics/semi_discretization.h"
#include "unit/dynamics/insperger.h"
using namespace millstudy::dynamics;
static void sys(benchmark::State& s){ for(auto _:s){ benchmark::DoNotOptimize(testing::insperger_slot(5000,1.0)); } }
static void avg(benchmark::State& s){ auto d=testing::insperger_slot(5000,1.0); for(auto _:s){ benchmark::DoNotOptimize(d.averages(int(s.range(0)))); } }
static void build(benchmark::State& s){ auto d=testing::insperger_slot(5000,1.0); for(auto _:s){ SemiDiscretizedMap m(d,{int(s.range(0)),0}); benchmark::DoNotOptimize(m); } }
static void apply(benchmark::State& s){ auto d=testing::insperger_slot(5000,1.0); SemiDiscretizedMap m(d,{int(s.range(0)),0}); Eigen::VectorXd a=Eigen::VectorXd::Ones(m.size()),b=a; for(auto _:s){ m.apply(a.data(),b.data()); benchmark::DoNotOptimize(b.data()); } }
static void eig(benchmark::State& s){ auto d=testing::insperger_slot(5000,1.0); SemiDiscretizedMap m(d,{int(s.range(0)),0}); DominantEigenvalue e; for(auto _:s){ e=dominant_eigenvalue(m.map()); } s.counters["apps"]=e.applications; }
static void cbuild(benchmark::State& s){ auto d=testing::insperger_slot(5000,1.0); for(auto _:s){ CollocationMap m(d,{int(s.range(0)),4.0}); benchmark::DoNotOptimize(m); } }
static void capply(benchmark::State& s){ auto d=testing::insperger_slot(5000,1.0); CollocationMap m(d,{int(s.range(0)),4.0}); Eigen::VectorXd a=Eigen::VectorXd::Ones(m.size()),b=a; for(auto _:s){ m.apply(a.data(),b.data()); benchmark::DoNotOptimize(b.data()); } s.counters["size"]=m.size(); }
static void ceig(benchmark::State& s){ auto d=testing::insperger_slot(5000,1.0); CollocationMap m(d,{int(s.range(0)),4.0}); DominantEigenvalue e; for(auto _:s){ e=dominant_eigenvalue(m.map()); } s.counters["apps"]=e.applications; }
static void full(benchmark::State& s){ auto d=testing::insperger_slot(5000,1.0);  Floquet e; for(auto _:s){ e=floquet(d,{1e-3}); } s.counters["level"]=e.level; }
BENCHMARK(sys); BENCHMARK(avg)->Arg(40)->Arg(200); BENCHMARK(build)->Arg(40)->Arg(200); BENCHMARK(apply)->Arg(40)->Arg(200); BENCHMARK(eig)->Arg(40)->Arg(200);
BENCHMARK(cbuild)->Arg(6)->Arg(8); BENCHMARK(capply)->Arg(6)->Arg(8); BENCHMARK(ceig)->Arg(6)->Arg(8); BENCHMARK(full);
BENCHMARK_MAIN();
