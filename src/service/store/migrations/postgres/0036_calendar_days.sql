-- How many milliseconds the time zone of the course is ahead of UTC, and since when. The database knows no zones: the service writes it
-- when it starts and when the zone is set.
CREATE TABLE zone_offsets (
    starts_at BIGINT PRIMARY KEY,
    ahead     BIGINT NOT NULL
);

-- By how many milliseconds each submission is late, and what that takes off. A day is one of the calendar in the zone of the course, so
-- that what counts is by how much the local time is later; an hour is an hour. What a teacher uploads is never late.
DROP VIEW lateness;
CREATE VIEW lateness AS
SELECT submission_id, late,
    CAST(CASE WHEN late > 0 AND score IS NOT NULL THEN
        GREATEST(0, LEAST(max_score * late_percent * GREATEST(1, (late + shift + late_span - 1) / late_span) / 100,
            score - max_score * late_floor / 100))
    ELSE 0 END AS DOUBLE PRECISION) AS penalty
FROM (SELECT submission_id, score, max_score, late_percent, late_span, late_floor, late,
        CASE WHEN late > 0 AND late_span = 86400000 THEN
            coalesce((SELECT z.ahead FROM zone_offsets z WHERE z.starts_at <= received_at ORDER BY z.starts_at DESC LIMIT 1), 0)
            - coalesce((SELECT z.ahead FROM zone_offsets z WHERE z.starts_at <= due_at ORDER BY z.starts_at DESC LIMIT 1), 0)
        ELSE 0 END AS shift
    FROM (SELECT submission_id, score, max_score, late_percent, late_span, late_floor, received_at, due_at,
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
            LEFT JOIN group_extensions g ON g.assignment = s.assignment AND g.group_name = t.group_name) AS due)
        AS measured) AS shifted;
