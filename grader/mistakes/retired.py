"""Ids of mistakes that the catalogue had: reports and ledgers of earlier versions name them.

A run shows what such a program did, and the search finds what helps.
"""

from __future__ import annotations

NODE = """
    abstract_method adds_before_log adds_twice alarm_for_timer answer_waited any_change
    argument_frozen argument_twice arguments_needed arguments_refused arrow as_code asyncio_used
    attribute_hides_method attribute_of_method attribute_other_name attribute_set_late
    await_of_other base_called base_created base_first base_for_super base_not_class
    base_replaced base_stops below_with call_assigned callback_decorated callback_never_ends
    callback_of_class callback_parameter callback_repeats callback_text callback_waits
    callback_without_message callback_yields called_at_once called_by_hand calls_itself
    class_ended class_is_dataclass class_takes_nothing class_to_executor class_twice
    cleanup_in_loop clears_terminal code_in_text colon_for_equals colour_codes comma_for_dot
    comment_sign commented_out compared_not_assigned config_not_read constructor_repeats
    context_manager copy_increased count_if counter_global counter_in_text counter_is_list
    counter_made_text counter_multiplied counter_not_number counter_of_class counter_other_name
    counter_other_value counter_passed counter_reset counts_elsewhere counts_in_variable
    debug_inside declared_twice decorator_not_called decorator_returns_none def_below
    default_counts default_shared define_comment defined_under_guard destroys_timer
    dict_attribute digits_joined dollar dot_for_comma dot_for_sign end_callback_called
    end_callback_text end_order endless_generator ends_in_callback error_logged
    error_only_logged error_suppressed except_no_class exception_as_condition executor_ended
    executor_with_node f_and_format f_in_quotes field_of_type field_order field_replaced
    fields_frozen finished_elsewhere first_base_alone foreign_letter format_value_missing
    function_of_module get_logger_arguments global_lost group_class helper_never_sets
    helper_no_self helper_not_called import_inside import_node import_own in_namespace
    inherited_method init_arguments init_in_guard init_inside_super init_late init_no_self
    init_other_name init_returns init_runs_again init_tested inner_callback_parameter
    inner_node_not_spun inner_not_called inside_call interrupt_swallowed iterator_ended
    join_between lambda_not_called last_def_counts len_of_number letter_for_digit level_set
    lifecycle_node line_in_parts line_made_anew list_shown list_to_executor lock_kept lock_twice
    log_if log_option log_order log_severity logged_no_text logger_arguments logger_by_name
    logger_called logger_method logger_not_called logger_of_node logger_of_other_node
    logs_before_timer logs_twice loop_in_callback made_anew made_each_round made_in_callback
    made_on_import made_property main_async main_gets_none main_prints makes_callback
    makes_itself measures_time message_class method_bind method_misspelt method_not_called
    method_twice module_not_imported mutable_default name_hides_function name_in_class
    name_local name_not_text name_reused name_shared named_tuple_set needs_ros never_added
    never_awaited next_twice no_enum node_as_default node_is_none node_not_kept not_an_iterator
    not_in_rclpy not_overridden not_reached nothing_returned nth_call number_changed
    number_format number_imported number_taken object_added object_in_text object_in_tuple
    one_digit other_key other_name_shown other_node_class other_node_spun other_step own_call
    own_topic parameter_field parameter_refused part_of_number partial_arguments partial_called
    percent_without_place period_caret period_duration period_far_too_long period_milliseconds
    period_negative period_not_number period_text period_tiny period_zero placeholder
    plain_alternative plain_node plus_reversed pop_from_the_end post_init_name prefix_increment
    print_of_python_2 prints_inside private_name property_counts property_of_itself property_set
    published_class python_logging quotes_missing rate_for_timer rate_sleep read_counts renamed
    replaced_nothing request_of_other_type response_not_returned result_dropped return_early
    ros_1 ros_not_running run_for_spin second_node_spun self_given self_left_out self_misspelt
    self_second service_arguments service_instantiated service_part_class service_type
    set_under_guard setter_adds setup_code severity_changed signal_handler single_underscores
    sleep_for_timer sleeps_beside_spin sleeps_in_callback small_change spin_elsewhere
    spin_has_timeout spin_in_daemon spin_loop_ends spin_not_called spin_not_reached
    spin_of_class spin_of_object spin_of_others spin_once spin_until_done spins_inside
    spun_in_turn spun_twice square_brackets stars_lost start_is_text starts_again
    starts_as_truth_value starts_elsewhere static_self static_with_self status_of_main
    step_after_return step_is_text sum_not_returned super_arguments super_not_called
    super_of_base super_of_other_name super_with_self template_overwritten template_place
    text_built_once text_changed text_elsewhere text_grows text_is_tuple text_joined text_kept
    text_not_a_number text_operator text_outside text_repeated text_without_number
    thread_arguments thread_for_timer thread_goes_on thread_timer threading_timer time_for_count
    timer_after_spin timer_again timer_argument_missing timer_arguments_swapped
    timer_at_class_level timer_cancelled timer_class timer_hides_method timer_if
    timer_in_callback timer_in_quotes timer_method timer_not_started timer_of_other_node
    timer_other_callback timer_reset timer_throttled topic_of_two_types two_nodes_count
    two_spun_at_once two_timers two_ways_to_count type_first value_cached value_for_object
    value_forgotten variable_for_self variable_not_set waits_at_end waits_for_service
    waits_for_spin with_method written_without_logger zero_is_false
"""
PACKAGING = """
    node.def_inside node.environment node.main_takes_none node.of_tutorial
    node.spin_of_none node.waits_first setup.brackets
    setup.colon_for_equals setup.dash_in_target setup.group_twice setup.no_equals setup.no_name
    setup.no_target setup.slash_in_target setup.space_in_name setup.space_in_target
    setup.two_colons setup.two_equals
"""
RETIRED = frozenset((*(f"node.{slug}" for slug in NODE.split()), *PACKAGING.split()))
