#include <lore/evaluation/evaluator.h>

namespace lore {

Evaluation evaluate_plainly(EvaluationContext const& context, Genome const& genome) {
    Trace const trace = record_episode(*context.world, compile(genome), context.episode);
    Evaluation evaluation;
    evaluation.reward = trace.reward;
    evaluation.descriptors = describe(context.world->facts(), trace);
    if (context.shaper) {
        Shaper::Reader reader = context.shaper->reader();
        ShapingState state;
        for (Window const& window : windows_of(trace, context.shaper->base().config().window_length))
            reader.see(window, state);
        evaluation.shaping = reader.value(state);
        if (context.shaper->rule() == ShapingRule::share) evaluation.shown = std::move(state.shown);
    }
    return evaluation;
}

std::vector<Evaluation> SerialEvaluator::evaluate(std::span<Genome const* const> genomes, CompletionListener*) {
    return evaluate_batch(context_, genomes);
}

}   // namespace lore
