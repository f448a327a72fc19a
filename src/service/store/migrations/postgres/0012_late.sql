-- How long after the due date (`closes_at`) a hand-in is still in time, in milliseconds.
ALTER TABLE assignments ADD COLUMN grace BIGINT NOT NULL DEFAULT 0;
-- Until when late hand-ins are taken; none: not at all.
ALTER TABLE assignments ADD COLUMN late_until BIGINT;
-- What a late hand-in loses for each span (milliseconds) that has begun since the due date, and what this leaves at least:
-- both in percent of all points.
ALTER TABLE assignments ADD COLUMN late_percent DOUBLE PRECISION NOT NULL DEFAULT 0;
ALTER TABLE assignments ADD COLUMN late_span BIGINT NOT NULL DEFAULT 86400000;
ALTER TABLE assignments ADD COLUMN late_floor DOUBLE PRECISION NOT NULL DEFAULT 0;
-- Which of somebody's hand-ins counts: 'best', 'last' or 'chosen'.
ALTER TABLE assignments ADD COLUMN counting TEXT NOT NULL DEFAULT 'best';

-- When it was chosen to count; the latest choice of somebody holds.
ALTER TABLE submissions ADD COLUMN chosen_at BIGINT;

-- The group of the course that a student is in; empty: none.
ALTER TABLE students ADD COLUMN group_name TEXT NOT NULL DEFAULT '';

-- Deadlines of whole groups, in place of that of the homework.
CREATE TABLE group_extensions (
    assignment TEXT NOT NULL REFERENCES assignments (id),
    group_name TEXT NOT NULL,
    closes_at  BIGINT NOT NULL,
    reason     TEXT NOT NULL,
    PRIMARY KEY (assignment, group_name)
);

-- By how many milliseconds each submission is late, and what that takes off. What a teacher uploads is never late.
CREATE VIEW lateness AS
SELECT submission_id, late,
    CAST(CASE WHEN late > 0 AND score IS NOT NULL THEN
        GREATEST(0, LEAST(max_score * late_percent * ((late + late_span - 1) / late_span) / 100, score - max_score * late_floor / 100))
    ELSE 0 END AS DOUBLE PRECISION) AS penalty
FROM (SELECT submission_id, score, max_score, late_percent, late_span, late_floor,
        CASE WHEN due_at IS NULL OR via IN ('editor', 'batch') OR received_at <= due_at + grace THEN 0
        ELSE received_at - due_at END AS late
    FROM (SELECT s.id AS submission_id, s.via, s.received_at, r.score, r.max_score,
            a.grace, a.late_percent, a.late_span, a.late_floor,
            CASE WHEN a.closes_at IS NULL THEN NULL ELSE
                GREATEST(a.closes_at, coalesce(e.closes_at, 0), coalesce(g.closes_at, 0)) END AS due_at
        FROM submissions s JOIN assignments a ON a.id = s.assignment
        LEFT JOIN reports r ON r.submission_id = s.id
        LEFT JOIN students t ON t.id = s.student_id
        LEFT JOIN extensions e ON e.assignment = s.assignment AND e.student_id = s.student_id
        LEFT JOIN group_extensions g ON g.assignment = s.assignment AND g.group_name = t.group_name) AS due) AS measured;
