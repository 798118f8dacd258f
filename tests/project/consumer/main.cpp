// Evaluates one random controller on the source task with the installed library.
#include <lore/evaluation/evaluator.h>

#include <cstdio>

int main() {
    lore::SerialEvaluator evaluator{lore::EvaluationContext{lore::load_arena("collectball", "source"), {}, {}}};
    lore::Genome const genome = lore::founder(lore::Stream{1, lore::Purpose::founder});
    lore::Genome const* const genomes[]{&genome};
    lore::Evaluation const evaluation = evaluator.evaluate(genomes).front();
    std::printf("balls %d, %zu words\n", evaluation.balls, evaluation.descriptors.bits.size());
    return evaluation.descriptors.bits.size() == 4000 ? 0 : 1;
}
