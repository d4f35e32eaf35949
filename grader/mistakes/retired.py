"""Ids of mistakes that the catalogue had: reports and ledgers of earlier versions name them.

A run shows what such a program did, and the search finds what helps.
"""

from __future__ import annotations

NODE = """
    abstract_method alarm_for_timer any_change argument_frozen argument_twice arguments_needed
    arguments_refused arrow as_code asyncio_used attribute_hides_method attribute_of_method
    attribute_other_name await_of_other base_called base_created base_first base_for_super
    base_replaced base_stops below_with call_assigned callback_waits callback_yields
    called_at_once calls_itself class_is_dataclass class_takes_nothing class_to_executor
    class_twice cleanup_in_loop clears_terminal code_in_text colon_for_equals colour_codes
    comma_for_dot comment_sign commented_out config_not_read copy_increased count_if
    counter_is_list counter_made_text counter_multiplied counter_of_class counter_other_name
    counter_other_value counter_passed counts_elsewhere counts_in_variable declared_twice
    decorator_not_called decorator_returns_none def_below default_counts default_shared
    define_comment defined_under_guard destroys_timer dict_attribute digits_joined dollar
    dot_for_comma dot_for_sign endless_generator ends_in_callback error_logged error_only_logged
    error_suppressed except_no_class exception_as_condition executor_ended executor_with_node
    f_and_format f_in_quotes field_order fields_frozen first_base_alone foreign_letter
    function_of_module global_lost group_class helper_never_sets helper_no_self
    helper_not_called import_own inherited_method init_in_guard init_inside_super
    init_other_name init_returns init_runs_again init_tested inner_callback_parameter
    inner_node_not_spun inner_not_called inside_call iterator_ended join_between last_def_counts
    len_of_number letter_for_digit lifecycle_node line_in_parts line_made_anew list_shown
    list_to_executor lock_kept lock_twice log_if log_order logged_no_text logger_by_name
    logger_of_node logger_of_other_node logs_before_timer made_anew made_each_round
    made_in_callback made_property main_async main_gets_none main_prints makes_callback
    makes_itself measures_time method_bind method_not_called mutable_default name_in_class
    name_local name_reused named_tuple_set needs_ros never_added never_awaited next_twice
    no_enum node_as_default node_is_none not_an_iterator not_in_rclpy not_overridden
    nothing_returned nth_call number_changed number_imported number_taken object_added
    object_in_text object_in_tuple one_digit other_key other_name_shown other_node_class
    other_node_spun own_call own_topic parameter_field parameter_refused part_of_number
    partial_arguments partial_called period_caret period_duration period_far_too_long
    period_tiny placeholder plain_alternative pop_from_the_end post_init_name prefix_increment
    print_of_python_2 private_name property_counts property_of_itself property_set
    python_logging rate_for_timer read_counts renamed replaced_nothing result_dropped
    return_early ros_not_running run_for_spin second_node_spun self_given self_left_out
    self_second set_under_guard setter_adds setup_code signal_handler sleep_for_timer
    sleeps_beside_spin spin_elsewhere spin_has_timeout spin_in_daemon spin_loop_ends
    spin_not_reached spin_of_object spin_of_others spin_until_done spun_in_turn spun_twice
    stars_lost starts_again starts_as_truth_value static_self static_with_self status_of_main
    step_after_return sum_not_returned super_arguments super_of_base super_of_other_name
    template_overwritten template_place text_changed text_joined text_kept text_operator
    text_repeated thread_arguments thread_for_timer thread_goes_on thread_timer threading_timer
    timer_again timer_cancelled timer_class timer_hides_method timer_if timer_in_quotes
    timer_method timer_not_started timer_of_other_node timer_other_callback timer_reset
    timer_throttled two_nodes_count two_spun_at_once two_timers two_ways_to_count type_first
    value_cached value_for_object variable_not_set waits_at_end waits_for_spin with_method
    written_without_logger zero_is_false
"""
RETIRED = frozenset(f"node.{slug}" for slug in NODE.split())
